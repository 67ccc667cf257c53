#pragma once

/// Cells in order of gap: the order in which they come into contact as the upper surface is brought down.
///
/// A histogram of the gap puts cells into buckets of equal width; only the buckets that can come into contact are
/// sorted. The buckets keep count, mean and variance of their gaps, from which the load sums of all steps are made.

#include <cstdint>
#include <vector>

#include "mems_stiction/approach/gap_field.hpp"

namespace mems_stiction {

struct OrderedCell {
  double gap;  ///< [m]
  std::int32_t cell;
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

  /// Sorted by gap, then by cell; at least contactLimit() of them, and some more beyond.
  const std::vector<OrderedCell>& cells() const { return cells_; }
  /// Number of cells in contact at the first gap level that reaches the contact fraction limit.
  int contactLimit() const { return contact_limit_; }
  /// Number of ordered cells with gap < approach.
  int countBelow(double approach) const;

  double bucketWidth() const { return bucket_width_; }
  const std::vector<GapMoments>& buckets() const { return buckets_; }
  /// Index of the first ordered cell past `bucket`; the cells' end if the bucket lies beyond the ordered ones.
  int endOfBucket(int bucket) const;
  /// Number of leading buckets whose cells are all in cells().
  int orderedBuckets() const { return ordered_buckets_; }

 private:
  int bucketOf(double gap) const;

  double bucket_width_ = 1.0;
  double inverse_width_ = 1.0;
  int ordered_buckets_ = 0;
  int contact_limit_ = 0;
  std::vector<GapMoments> buckets_;
  std::vector<std::int32_t> bucket_end_;
  std::vector<OrderedCell> cells_;
};

}  // namespace mems_stiction
