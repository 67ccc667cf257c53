#pragma once

/// Cells in order of gap: the order in which they come into contact as the upper surface is brought down.
///
/// A histogram of the gap puts the cells that can come into contact into narrow buckets, lowest first. Inside a bucket
/// they are sorted only when somebody asks for a place inside it: most buckets lie whole within one step of the
/// approach. The buckets keep count, mean and variance of their gaps, from which the load sums of all steps are made;
/// cells that stay apart are only counted.

#include <cstdint>
#include <vector>

#include "mems_stiction/approach/gap_field.hpp"

namespace mems_stiction {

struct OrderedCell {
  double gap;  ///< [m]
  std::int32_t cell;
  std::int32_t row;
};

/// Gaps of one bucket, or of several neighbouring ones.
struct GapMoments {
  double count = 0.0;
  double mean = 0.0;      ///< [m]
  double variance = 0.0;  ///< [m^2]
};

class GapOrder {
 public:
  /// @param max_contact_fraction contact is searched up to this share of the valid cells, in (0, 1].
  void build(const GapField& field, double max_contact_fraction);

  /// In order of bucket; at least contactLimit() of them, and some more beyond.
  const std::vector<OrderedCell>& cells() const { return cells_; }
  /// Number of cells in contact at the first gap level that reaches the contact fraction limit. The cells up to there
  /// are those of the smallest gaps.
  int contactLimit() const { return contact_limit_; }
  /// Number of ordered cells with gap < approach; these are the first cells afterwards.
  int countBelow(double approach);
  /// Sorts all cells between two places by gap, then by cell. `begin` must be such a place as countBelow() returns.
  void sortBetween(int begin, int end);

  /// Buckets 0 .. bucketCount()-1 share the range of the gap; each is bucketWidth() wide [m].
  int bucketCount() const { return bucket_count_; }
  double bucketWidth() const { return bucket_width_; }
  /// Number of leading buckets whose cells are in cells(); a multiple of kBucketsPerTailBucket.
  int orderedBuckets() const { return ordered_buckets_; }
  /// Index of the first ordered cell past `bucket`, for the ordered buckets.
  int endOfBucket(int bucket) const { return bucket_end_[static_cast<std::size_t>(bucket)]; }
  /// Gaps of each ordered bucket.
  const std::vector<GapMoments>& orderedMoments() const { return ordered_moments_; }
  /// Gaps of the buckets beyond, kBucketsPerTailBucket of them together, each cell at the middle of its bucket: they
  /// are far from contact against the width of a bucket.
  const std::vector<GapMoments>& tailMoments() const { return tail_moments_; }

  static constexpr int kBucketsPerTailBucket = 16;

 private:
  int bucketOf(double gap) const;
  void countGaps(const GapField& field);
  void chooseOrderedBuckets(int wanted);
  void collectCells(const GapField& field);
  void measureTail();
  void measureOrderedBuckets();
  void sortBucket(int bucket);

  int bucket_count_ = 0;
  double bucket_width_ = 1.0;
  double inverse_width_ = 1.0;
  int ordered_buckets_ = 0;
  int contact_limit_ = 0;
  std::vector<std::int32_t> bucket_end_;
  std::vector<std::int32_t> near_cells_;
  std::vector<std::uint8_t> is_sorted_;
  std::vector<OrderedCell> cells_;
  std::vector<GapMoments> ordered_moments_;
  std::vector<GapMoments> tail_moments_;
};

}  // namespace mems_stiction
