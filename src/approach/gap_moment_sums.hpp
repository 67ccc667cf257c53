#pragma once

/// @file
/// How the moments of a bucket come about: as sums about its lower end, from which the moments are
/// taken when all gaps are in.

#include <algorithm>

#include "approach/gap_order.hpp"

namespace mems_stiction {

/// Adds gaps that lie `excess` [m] beyond the bucket's lower end.
inline void addGaps(GapMoments& moments, double count, double excess) {
  moments.count += count;
  moments.mean += count * excess;
  moments.variance += count * excess * excess;
}

/// Sums of gaps about the bucket's lower end become moments; no digits are lost to the size of the
/// gap.
inline void finishMoments(GapMoments& moments, double lower_end) {
  if (moments.count == 0.0) return;
  const double mean_excess = moments.mean / moments.count;
  moments.variance = std::max(0.0, moments.variance / moments.count - mean_excess * mean_excess);
  moments.mean = lower_end + mean_excess;
}

}  // namespace mems_stiction
