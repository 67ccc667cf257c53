#pragma once

/// @file
/// Sums over all cells that are apart, at any approach, without a pass over the frame: cells near
/// contact one by one, the rest from a pyramid of histogram buckets, each level twice as wide, so
/// that no bucket is wide against the distance that the summed law sees.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "approach/gap_order.hpp"
#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {

/// What a law's sum needs to know of it.
struct PyramidRule {
  double kink =
      0.0;  ///< gap at which the law has a kink; no bucket that stands for cells lies across it [m]
  double offset = 0.0;     ///< the law varies over gap + offset, not over the gap [m], >= 0
  double steepness = 1.0;  ///< its power of gap + offset over 3, >= 1: buckets are narrower by it
};

/// Calls take(four gaps - approach, in packets) for one four of cells after the other.
/// @return how many cells were taken: up to three are left
template <typename Take>
MEMS_STICTION_INLINE std::size_t visitFours(const OrderedCell* cells, std::size_t count,
                                            double approach, const Take& take) {
  const std::size_t in_fours = count / Packet::kCount * Packet::kCount;
  for (std::size_t i = 0; i < in_fours; i += Packet::kCount) {
    take(Packet(cells[i].gap, cells[i + 1].gap, cells[i + 2].gap, cells[i + 3].gap) - approach);
  }
  return in_fours;
}

/// Levels of buckets over the gaps of one frame.
class GapPyramid {
 public:
  /// Prepares the sums for a frame; keeps a reference to the order. Memory is reused.
  void prepare(const GapOrder& order);

  /// The cells apart by gap - approach when the first `contact_count` ordered ones are in contact:
  /// - @p on_cells called with (first cell, count), the cells that are to be summed one by one
  /// - @p on_moments called with GapMoments, each standing for its cells
  template <typename OnCells, typename OnMoments>
  MEMS_STICTION_INLINE void visit(double approach, int contact_count, const PyramidRule& rule,
                                  const OnCells& on_cells, const OnMoments& on_moments) const;

 private:
  /// A bucket may stand for its cells when what a law with the third power of the gap sees is at
  /// least this many times its width.
  static constexpr double kGapsPerWidth = 12.0;
  /// Buckets next to the contact whose cells are summed one by one: enough for the Taylor series
  /// beyond, and, while they are wide, as many as reach the kink.
  static constexpr double kMostNearBuckets = 64.0;
  static constexpr std::size_t kTailLevel = 4;
  static_assert(1 << kTailLevel == GapOrder::kBucketsPerTailBucket,
                "the tail's buckets are a level of the pyramid");

  /// momentsOf(k)[i]: buckets i 2^k .. (i + 1) 2^k - 1 together; level 0 is the order's own.
  const std::vector<GapMoments>& momentsOf(std::size_t level) const {
    return level == 0 ? order_->orderedMoments() : coarser_levels_[level - 1];
  }

  const GapOrder* order_ = nullptr;
  std::vector<std::vector<GapMoments>> coarser_levels_;  ///< from level 1 on
};

template <typename OnCells, typename OnMoments>
MEMS_STICTION_INLINE void GapPyramid::visit(double approach, int contact_count,
                                            const PyramidRule& rule, const OnCells& on_cells,
                                            const OnMoments& on_moments) const {
  const int bucket_count = order_->bucketCount();
  const double width = order_->bucketWidth();
  const double kink_in_widths = rule.kink / width;
  const double offset_in_widths = rule.offset / width;
  const double gaps_per_width = kGapsPerWidth * rule.steepness;
  const double fewest_near = std::max(gaps_per_width - offset_in_widths, 0.0);
  const int near_buckets =
      static_cast<int>(std::ceil(std::clamp(kink_in_widths, fewest_near, kMostNearBuckets)));
  // a group is near as a whole: its cells are not in order
  const double past_near =
      std::clamp<double>(approach / width + 1.0 + near_buckets, 0.0, bucket_count);
  int bucket = order_->groupStartFrom(static_cast<int>(past_near));
  const int near_end = order_->cellsBefore(bucket);
  on_cells(order_->cells().data() + contact_count,
           static_cast<std::size_t>(std::max(near_end - contact_count, 0)));
  while (bucket < bucket_count) {
    const double seen_in_widths = bucket - approach / width + offset_in_widths;
    std::size_t level = bucket < order_->orderedBuckets() ? 0 : kTailLevel;
    while (level < coarser_levels_.size() && bucket % (2 << level) == 0) {
      const double wider = 2 << level;
      const double gap_in_widths = bucket - approach / width;
      const bool has_kink =
          gap_in_widths < kink_in_widths && kink_in_widths < gap_in_widths + wider;
      if (has_kink || seen_in_widths < gaps_per_width * wider) break;
      ++level;
    }
    const GapMoments& gaps = momentsOf(level)[static_cast<std::size_t>(bucket >> level)];
    if (gaps.count > 0.0) on_moments(gaps);
    bucket += 1 << level;
  }
}

}  // namespace mems_stiction
