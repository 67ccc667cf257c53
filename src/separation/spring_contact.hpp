#pragma once

/// @file
/// A relief whose cells hang on equal springs and attract a plane: what it takes to draw the plane
/// away.
///
///     g = Z + r - u,   k u = t(g) + p(g - z0) + p_w(g - z0)
///
/// Z is the height of the plane, r the relief below its highest point, u what the spring gives, p
/// the pressure of a field that stays, that of contact where cells are pressed, p_w that of water,
/// which fills gaps up to a width. A cell stays on its branch while the plane goes up, and lets go
/// where -t' - p' = k, and where its gap is wider than water fills. With k = 2 U/(A sigma^2) all
/// springs together store the flattening energy U when all is flat.

#include <vector>

#include "separation/contact_traction.hpp"

namespace mems_stiction {

/// Cells of nearly equal height.
struct ReliefClass {
  double depth;  ///< below the highest point, mean of its cells [m]
  double share;  ///< of all valid cells [-]
};

/// Sorts depths into classes of equal width.
class ReliefClasses {
 public:
  /// - @p range of the depths that are to come [m], >= 0
  ReliefClasses(double lowest, double highest);
  void add(double depth);
  /// By ascending depth from the lowest one, which counts as 0.
  std::vector<ReliefClass> classes() const;

 private:
  double lowest_;
  double inverse_width_;
  std::vector<double> sums_;
  std::vector<int> counts_;
};

/// One height of the plane, per area.
struct SpringState {
  double height = 0.0;    ///< Z; z0 where the highest cell lies in the plane of contact [m]
  double traction = 0.0;  ///< mean [Pa], attraction positive
  double energy = 0.0;    ///< of springs and law [J/m^2], 0 apart
};

/// The branch from the deepest approach, mean of the relief in the plane of contact, to where the
/// last cell has let go.
/// - @p stiffness k [Pa/m], > 0, may be infinite
/// - @p field that stays on the way out
/// - @p water between the surfaces
std::vector<SpringState> springBranch(const std::vector<ReliefClass>& relief,
                                      const ContactTraction& law, const FieldLaw& field,
                                      const WaterLaw& water, double stiffness);

/// The state of least energy + pressure Z, from which surfaces are drawn apart.
std::vector<SpringState>::const_iterator restOf(const std::vector<SpringState>& branch,
                                                double pressure);
/// Share of the cells that repel at rest, between the states of a branch: Z + r <= z0 [-].
double repellingShare(std::vector<SpringState>::const_iterator rest,
                      const std::vector<SpringState>& branch, double pressure,
                      const std::vector<ReliefClass>& relief, double range);
/// Largest traction from a state on [Pa].
double strengthFrom(std::vector<SpringState>::const_iterator rest,
                    const std::vector<SpringState>& branch);

}  // namespace mems_stiction
