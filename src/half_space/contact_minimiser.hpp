#pragma once

/// @file
/// Which displacement brings two surfaces at a given height into equilibrium?
///
///     gap  g = Z + relief - u
///             Z: height of the upper body over first touch; relief >= 0 (0 at first touch)
///     E(u) = (1/2) sum u K u dA + sum phi(g) dA,   dphi/dg = t(g)
///     0    = K u - t(g), but for its mean where K does not resist one
///
/// Contacts are brought into equilibrium one by one (contact_windows.hpp) as long as that helps.
/// What is left, or all where contacts fill much of the frame, is Newton's method's: (K + t') s = t
/// - K u as far as it is of use (conjugate_gradients.hpp), and a step along s that lowers E. What
/// is kept, u and K u, is double; K u is worked out afresh when the steps since then may have left
/// a tenth of the residual that an equilibrium may have. Starting from the state before, it goes
/// downhill into the nearest minimum: a stable state.
///
/// Repulsion rises like (z0/g)^9, and Newton's steps run into that wall. So beyond twice the
/// pressure that was there so far it rises on its tangent, and no equilibrium counts in which
/// something is pressed harder: then the wall grows, and the search goes on.

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "half_space/coarse_answer.hpp"
#include "half_space/conjugate_gradients.hpp"
#include "half_space/contact_windows.hpp"
#include "half_space/half_space_grid.hpp"
#include "half_space/minimiser_settings.hpp"
#include "half_space/revertible_displacement.hpp"
#include "half_space/stiffness_operator.hpp"
#include "half_space/traction_law.hpp"
#include "numeric/large_pages.hpp"

namespace mems_stiction {

namespace evaluation_rows {
struct Sums;
}  // namespace evaluation_rows

/// What the frame as a whole does in one state, and how it was found.
struct ContactState {
  double height = 0.0;        ///< Z [m]
  double force = 0.0;         ///< sum of t dA, positive attracts [N]
  double energy = 0.0;        ///< E, 0 at infinity [J]
  double residual = 0.0;      ///< largest |K u - t| over 8 Gamma/(3 z0) [-]
  double contact_area = 0.0;  ///< of cells with a repulsive traction [m^2]
  double mean_gap = 0.0;      ///< of the valid cells [m]
  bool is_converged = false;
  int newton_steps = 0;
  int products = 0;  ///< applications of the preconditioner or of K: one pair of transforms each
};

/// Finds equilibria one after the other, each from the one before.
class ContactMinimiser {
 public:
  /// - @p response without an influence
  /// - @p relief frame_rows x frame_cols, row by row [m], >= 0; infinite where nothing was measured
  ContactMinimiser(const HalfSpaceGrid& grid, const TractionLaw& law,
                   const ElasticResponse& response, LargePageVector<double> relief,
                   const MinimiserSettings& settings);
  /// Of half-spaces.
  /// - @p contact_modulus [Pa], > 0
  ContactMinimiser(const HalfSpaceGrid& grid, const TractionLaw& law, double contact_modulus,
                   LargePageVector<double> relief, const MinimiserSettings& settings)
      : ContactMinimiser(grid, law, ElasticResponse{contact_modulus}, std::move(relief), settings) {
  }
  /// A window of a larger frame, with free edges, which has no windows of its own.
  /// - @p relief as above, less the displacement that is not this one's
  /// - @p fixed traction that this other displacement takes, frame_rows x frame_cols [Pa]; empty
  /// for none
  ContactMinimiser(const HalfSpaceGrid& grid, const TractionLaw& law,
                   const ElasticResponse& response, LargePageVector<double> relief,
                   LargePageVector<float> fixed, const MinimiserSettings& settings);

  /// The same window about other cells, as if it had just been made.
  /// - @p tolerance of the settings
  void restart(LargePageVector<double> relief, LargePageVector<float> fixed, double tolerance);

  /// False if it was cancelled while it set itself up: then only what follows from the frame may be
  /// asked for.
  bool isSetUp() const { return is_set_up_; }

  /// How one equilibrium is searched for.
  struct Search {
    /// What a cell moves in one Newton step at most, of z0: t' changes over such a distance. The
    /// more, the fewer steps, and the farther the equilibrium may be where surfaces attract each
    /// other.
    double longest_move = 1.0;
    double tolerance = 1.0;  ///< of that of the settings, >= 1
    /// Root of the mean square that may be left of the residual [Pa].
    double residual_norm = std::numeric_limits<double>::infinity();
  };

  /// The equilibrium next to the present displacement; what came before is left in place if
  /// cancelled.
  ContactState solve(double height, const Search& search);
  ContactState solve(double height) { return solve(height, Search()); }

  /// Begins a new state: what solve() changes from here on can be taken back. The displacement
  /// first moves on by `share` of how it changed from the state before to this one.
  void moveOn(double share);
  /// Takes back what changed since moveOn(); the next share is again of the change before.
  void takeBack() { displacement_.takeBack(); }
  /// The same, but the next share is of the change that was taken back.
  void takeBackForPart() { displacement_.takeBackForPart(); }
  /// Whether something flowed in the state just solved.
  bool hasFlow() const { return law_.flows() && lowest_gap_ < law_.closestGap(); }
  /// Whether something flowed, or may have with a smaller residual.
  bool isNearFlow() const { return law_.flows() && lowest_gap_ < kNearFlow * law_.closestGap(); }
  /// What flowed in the state just solved stays: cells closer than the closest gap lose the excess
  /// of their height.
  /// @return the work that the flow took [J]
  double acceptFlow(double height);

  /// Another law applies from now on; displacement and what has flowed stay.
  void setLaw(const TractionLaw& law);

  /// A state to come back to.
  struct Place {
    RevertibleDisplacement::Place displacement;
    LargePageVector<double> relief;
    LargePageVector<float> flowed;
  };
  Place place() const { return {displacement_.place(), relief_, flowed_}; }
  void goTo(Place&& place);

  /// K u, an array of the grid [Pa].
  const double* elasticTraction() const { return displacement_.traction(); }
  /// Gap [m] and pressure [Pa], positive where the cells repel each other; frame_rows x frame_cols
  /// CV_32FC1; NaN where nothing was measured.
  void maps(double height, cv::Mat& gaps, cv::Mat& pressures) const;
  /// What has flowed, by which the gap of two bodies apart has grown [m]; frame_rows x frame_cols,
  /// empty if none has.
  const LargePageVector<float>& flowed() const { return flowed_; }

  /// Of the valid cells [m].
  double largestRelief() const { return largest_relief_; }
  /// Of the valid cells [m^2].
  double validArea() const { return static_cast<double>(valid_count_) * grid_.cellArea(); }
  /// That the valid cells carry when all of them flow; infinity without a hardness [N].
  double largestLoad() const;
  bool isCancelled() const { return settings_.cancel != nullptr && settings_.cancel->load(); }
  const HalfSpaceGrid& grid() const { return grid_; }
  const TractionLaw& law() const { return law_; }
  int threads() const { return settings_.threads; }
  /// Smallest stiffness of the elastic bodies [Pa/m].
  double smallestStiffness() const { return stiffness_.smallest(); }

 private:
  /// Gaps over the closest one, where two thirds of the hardness are borne.
  static constexpr double kNearFlow = 1.05;
  struct Evaluation;
  /// Whether something is pressed harder than the wall knows.
  bool isBeyondWall(const Evaluation& now) const;
  /// The wall reaches up to twice the pressure there is.
  void raiseWall(const Evaluation& now);
  /// What follows from the relief.
  void takeRelief(LargePageVector<double> relief);
  using Step = RevertibleDisplacement::Step;
  /// One row's share at u + length s.
  /// - @p with_slopes whether t' is kept for Newton's method
  evaluation_rows::Sums evaluateRow(int row, double height, const Step& step, bool with_slopes);
  Evaluation evaluationOf(const evaluation_rows::Sums& sums, bool with_slopes) const;
  /// At u, and at u + length s, along the step of the conjugate gradients.
  Evaluation evaluate(double height);
  Evaluation evaluateAlong(double height, double length);
  /// At u, which goes on by `share` of the last change first, if there is one.
  Evaluation moveAndEvaluate(double height, std::optional<float> share);
  /// At u, which goes by `length` (1, or -1 for back again) times the displacement that answers a
  /// change of traction.
  Evaluation answerAndEvaluate(double height, double length);
  /// Gaps of a row of the frame [m].
  void gapsOfRow(int row, double height, double* gaps) const;
  /// Whether an evaluation is nearer to equilibrium than the one before.
  static bool isNearer(const Evaluation& now, const Evaluation& before, double promised);
  /// Relaxes the contacts and goes there if that is nearer to equilibrium. @return whether it is
  /// worth doing again
  bool relaxContacts(double height, Evaluation& now);
  bool usesWindows() const { return windows_ != nullptr && windows_pause_ == 0; }
  /// How often windows failed in the present state decides whether they are tried in the next ones.
  void noteWindows(int failures);
  void takeStep(double length);
  void refreshElasticTraction();
  int products() const { return exact_products_ + window_products_ + gradients_.products(); }

  HalfSpaceGrid grid_;
  TractionLaw law_;
  /// Up to which the law is followed on the way to an equilibrium [Pa]; a window has the frame's
  /// wall for its law.
  double wall_pressure_ = std::numeric_limits<double>::infinity();
  TractionLaw wall_;  ///< the law that is
  MinimiserSettings settings_;
  SpectrumMemory spectrum_;
  StiffnessOperator<float> stiffness_;
  StiffnessOperator<double> exact_stiffness_;
  std::unique_ptr<CoarseAnswer> coarse_;  ///< none in a window, nor where there are too few cells
  ConjugateGradients gradients_;
  LargePageVector<double> relief_;
  double largest_relief_ = 0.0;
  std::size_t valid_count_ = 0;
  RevertibleDisplacement displacement_;
  LargePageVector<float> flowed_;
  LargePageVector<float> fixed_;  ///< traction of another displacement [Pa]; none but in a window
  std::unique_ptr<ContactWindows> windows_;  ///< none in a window
  int windows_pause_ = 0;                    ///< in so many states they are not tried
  int last_pause_ = 0;                       ///< how long the last one was
  double lowest_gap_ = 0.0;                  ///< in the state just solved [m]
  double mean_traction_ = 0.0;               ///< that K does not resist, as far as it is known [Pa]
  int exact_products_ = 0;                   ///< of K u
  int window_products_ = 0;
  bool is_set_up_ = false;
};

}  // namespace mems_stiction
