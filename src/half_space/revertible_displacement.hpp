#pragma once

/// @file
/// Where have the surfaces moved, and how do they go back where a step was too long?
///
/// The displacement u, its elastic traction K u, and what both have changed since a state was
/// begun. The next state begins with a share of the change to the one before: equilibria follow
/// each other along a curve. Steps add to K u in single precision, which leaves an error that is
/// known; when it counts, whoever can work K u out afresh does so.
///
///     displacement.begin(share, error);
///     const std::optional<float> going_on = displacement.takeShare();
///     ... goOn(row, *going_on) for each row, then step(row, ...) as often as it takes ...
///     displacement.takeBack();                    // or begin() again

#include <atomic>
#include <cstddef>
#include <optional>

#include "half_space/half_space_grid.hpp"
#include "numeric/large_pages.hpp"

namespace mems_stiction {

/// u and K u on arrays of the grid, 0 at first. Rows may be changed by several threads at once.
class RevertibleDisplacement {
 public:
  /// - @p tracks_traction false saves memory: after begin() with a share, and when a change was
  /// taken back, K u must be
  ///   worked out afresh
  /// - @p cancel looked at before each array is made; may be null
  RevertibleDisplacement(const HalfSpaceGrid& grid, bool tracks_traction, int threads,
                         const std::atomic<bool>* cancel);

  const double* values() const { return values_.data(); }      ///< u [m]
  const double* traction() const { return traction_.data(); }  ///< K u [Pa]
  double* traction() { return traction_.data(); }              ///< to be worked out afresh
  /// By which traction() may have left K u; infinity where it is not known [Pa].
  double staleness() const { return staleness_; }
  /// What a step may have added to that [Pa].
  void addStaleness(double traction);
  /// traction() is K u.
  void noteFresh() { staleness_ = 0.0; }

  /// Begins a change, which can be taken back. It is first to go on by `share` of the change
  /// before.
  /// - @p traction_error that going on leaves in K u [Pa]
  void begin(double share, double traction_error);
  /// By which share u is still to go on since begin(); none once this was asked: a state may take
  /// several searches.
  std::optional<float> takeShare();
  /// One row by that share.
  void goOn(int row, float share);

  /// A step of one row.
  struct Step {
    double length;
    const float* step;      ///< s [m]
    const float* traction;  ///< K s [Pa]
  };
  /// u + length s for one row.
  void step(int row, const Step& step);

  /// Takes back what changed since begin(); the next share is again of the change before.
  void takeBack();
  /// The same, but the next share is of the change that was taken back.
  void takeBackForPart();

  /// A displacement to come back to.
  struct Place {
    LargePageVector<double> values;
    LargePageVector<double> traction;
    double staleness;
  };
  Place place() const { return {values_, traction_, staleness_}; }
  void goTo(Place&& place);
  /// Back to 0.
  void reset();

 private:
  void swapChanges();

  HalfSpaceGrid grid_;
  bool tracks_traction_;
  int threads_;
  LargePageVector<double> values_;
  LargePageVector<double> traction_;
  double staleness_ = 0.0;
  double change_staleness_ =
      0.0;  ///< the same had K u not been worked out afresh since begin() [Pa]
  LargePageVector<float> change_;           ///< of u since begin() [m]
  LargePageVector<float> change_traction_;  ///< K of it [Pa]; none where it is not tracked
  LargePageVector<float> last_change_;      ///< the one before [m]
  LargePageVector<float> last_change_traction_;
  std::optional<float> share_ = 0.0F;
};

}  // namespace mems_stiction
