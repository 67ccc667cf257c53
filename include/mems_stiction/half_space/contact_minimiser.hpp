#pragma once

/// @file
/// Which displacement brings two surfaces at a given height into equilibrium?
///
///     gap  g = Z + relief - u          Z: height of the upper body over first touch; relief >= 0 (0 at first touch)
///     E(u) = (1/2) sum u K u dA + sum phi(g) dA,   dphi/dg = t(g)
///     0    = K u - t(g), but for its mean where K does not resist one
///
/// Newton's method: (K + t') s = t - K u as far as it is of use (conjugate_gradients.hpp), then a step along s that
/// lowers E. What is kept, u and K u, is double, and K u is worked out afresh before a state counts as equilibrium.
/// Starting from the state before, it goes downhill into the nearest minimum: a stable state.

#include <atomic>
#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/base/large_pages.hpp"
#include "mems_stiction/half_space/conjugate_gradients.hpp"
#include "mems_stiction/half_space/half_space_grid.hpp"
#include "mems_stiction/half_space/stiffness_operator.hpp"
#include "mems_stiction/half_space/traction_law.hpp"

namespace mems_stiction {

/// What the frame as a whole does in one state, and how it was found.
struct ContactState {
  double height = 0.0;    ///< Z [m]
  double force = 0.0;     ///< sum of t dA, positive attracts [N]
  double energy = 0.0;    ///< E, 0 at infinity [J]
  double residual = 0.0;  ///< largest |K u - t| over 8 Gamma/(3 z0) [-]
  bool is_converged = false;
  int newton_steps = 0;
  int products = 0;              ///< applications of the preconditioner or of K: one pair of transforms each
  bool met_instability = false;  ///< negative curvature on the way: the state before was not followed smoothly
};

/// Settings of the search.
struct MinimiserSettings {
  double tolerance = 1e-4;  ///< largest residual of an equilibrium [-]
  int max_newton_steps = 200;
  int threads = 1;
  const std::atomic<bool>* cancel = nullptr;
  std::function<void()> give_way;  ///< before each product; may be empty
};

/// Finds equilibria one after the other, each from the one before.
class ContactMinimiser {
 public:
  /// - @p contact_modulus [Pa], > 0
  /// - @p relief frame_rows x frame_cols, row by row [m], >= 0; infinite where nothing was measured
  ContactMinimiser(const HalfSpaceGrid& grid, const TractionLaw& law, double contact_modulus,
                   LargePageVector<double> relief, const MinimiserSettings& settings);

  /// False if it was cancelled while it set itself up: then only what follows from the frame may be asked for.
  bool isSetUp() const { return is_set_up_; }

  /// The equilibrium next to the present displacement; what came before is left in place if cancelled.
  ContactState solve(double height);

  /// Begins a new state: what solve() changes from here on can be taken back. The displacement first moves on by
  /// `share` of how it changed from the state before to this one.
  void moveOn(double share);
  /// Takes back what changed since moveOn(); the next share is again of the change before.
  void takeBack();
  /// What flowed in this state stays: cells closer than the closest gap lose the excess of their height.
  /// @return the work that the flow took [J]
  double keepFlow(double height);

  /// Cells with a repulsive traction, and the mean gap of the valid ones [m].
  struct Contact {
    int cells = 0;
    double mean_gap = 0.0;
  };
  Contact contactAt(double height) const;
  /// Gap [m] and pressure [Pa], positive where the cells repel each other; frame_rows x frame_cols CV_32FC1; NaN where
  /// nothing was measured.
  void maps(double height, cv::Mat& gaps, cv::Mat& pressures) const;
  /// What has flowed, by which the gap of two bodies apart has grown [m]; frame_rows x frame_cols, empty if none has.
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
  struct Evaluation;
  /// At u + length s.
  Evaluation evaluate(double height, double length);
  /// Gaps of a row of the frame [m].
  void gapsOfRow(int row, double height, double* gaps) const;
  void takeStep(double length);
  void refreshElasticTraction();
  int products() const { return exact_products_ + gradients_.products(); }

  HalfSpaceGrid grid_;
  TractionLaw law_;
  MinimiserSettings settings_;
  SpectrumMemory spectrum_;
  StiffnessOperator<float> stiffness_;
  StiffnessOperator<double> exact_stiffness_;
  ConjugateGradients gradients_;
  LargePageVector<double> relief_;
  double largest_relief_ = 0.0;
  std::size_t valid_count_ = 0;
  LargePageVector<double> displacement_;      ///< u [m]
  LargePageVector<double> elastic_traction_;  ///< K u [Pa]
  bool is_fresh_ = true;                      ///< elastic_traction_ is K u to double precision
  LargePageVector<float> change_;             ///< of u since moveOn() [m]
  LargePageVector<float> change_traction_;    ///< K of it [Pa]; none with free edges, to save memory
  LargePageVector<float> last_change_;        ///< the one before [m]
  LargePageVector<float> last_change_traction_;
  LargePageVector<float> flowed_;
  int exact_products_ = 0;  ///< of K u
  bool is_set_up_ = false;
};

}  // namespace mems_stiction
