#pragma once

/// @file
/// The way of a stage through a scan, by the places of its lines: whether it moved, and where it
/// turned. An encoder's noise is neither a move nor a turn.

#include <cstddef>
#include <vector>

namespace mems_stiction {

/// Follows a stage from line to line.
class StageWay {
 public:
  /// - @p line_pitch the step from line to line [m]; 0 = the longest that is usual
  explicit StageWay(double line_pitch) : step_(line_pitch), has_own_step_(line_pitch == 0.0) {}

  /// The next line, at this place along the motion [m].
  /// @return whether the stage went on, beyond every place of its present way
  bool add(double place);

  /// From the lowest place to the highest [m].
  double span() const { return high_ - low_; }
  /// A shorter move is noise [m].
  double leastMove() const;
  bool hasMoved() const { return span() > leastMove(); }
  /// Of each turn the first line behind it.
  const std::vector<std::size_t>& turns() const { return turns_; }
  /// Whether places fall on the first way.
  bool fallsFirst() const { return (direction_ < 0) == (turns_.size() % 2 == 0); }

 private:
  void takeStep(double step);

  double step_;
  bool has_own_step_;
  std::vector<double> steps_;   ///< in no order
  std::size_t renewed_at_ = 0;  ///< number of steps at which step_ is found anew
  std::size_t lines_ = 0, furthest_line_ = 0;
  double first_ = 0.0, last_ = 0.0, low_ = 0.0, high_ = 0.0;
  double furthest_ = 0.0;  ///< of the present way
  int direction_ = 0;      ///< of the present way; 0 = the stage has not moved
  std::vector<std::size_t> turns_;
};

/// What to add to each place so that lines of falling places lie where they were taken [m]. A stage
/// that turns stands until the backlash is taken up.
std::vector<double> slacks(const std::vector<double>& places, double backlash, double line_pitch);

}  // namespace mems_stiction
