#pragma once

/// @file
/// The gaps of an area's cells that are not in its frame of the highest ones: too far away to
/// touch, near enough to attract. They are summed by moments, in classes that are narrow against
/// how far away they are, and so as exactly as the near ones.

#include <cstdint>
#include <vector>

#include "approach/gap_order.hpp"
#include "approach/height_counts.hpp"

namespace mems_stiction {

/// Of the cells below a bucket of an area.
class FarGaps {
 public:
  /// - @p bucket cells from it on upwards are in the frame
  /// - @p top highest relief of all cells, from which gaps are counted [m]
  /// - @p range of the forces [m], > 0: no approach comes nearer to these cells than this
  FarGaps(const HeightCounts& counts, std::int64_t bucket, double top, double range);

  /// Cells with a smaller gap are all in the frame [m]; infinite if all are.
  double first() const { return first_; }
  std::int64_t count() const { return count_; }
  double gapSum() const { return gap_sum_; }  ///< [m]
  /// By ascending gap.
  const std::vector<GapMoments>& moments() const { return moments_; }
  /// Number of these cells with a gap below a limit [m].
  double cellsBelow(double limit) const;

 private:
  /// Classes are no wider than this part of the distance that a force sees.
  static constexpr double kPart = 1.0 / 64.0;

  double first_;
  double width_;  ///< of a bucket [m]
  std::int64_t count_ = 0;
  double gap_sum_ = 0.0;
  std::vector<GapMoments> moments_;
  std::vector<std::int64_t>
      counts_before_;  ///< per bucket by ascending gap: number of cells before it
};

}  // namespace mems_stiction
