#include "approach/gap_order.hpp"

#include <algorithm>
#include <cmath>

#include "approach/gap_moment_sums.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr int kMaxBuckets = 1 << 16;
constexpr int kMinBuckets = 1 << 6;
constexpr int kCellsPerBucket = 8;
/// Buckets beyond the contact limit that are ordered too: cells near the contact are summed one by
/// one, and the wider buckets of the tail start where their width is small against the gap.
constexpr int kBucketsBeyondLimit = 16 * GapOrder::kBucketsPerTailBucket;

int bucketCountFor(int valid_cells) {
  int count = kMinBuckets;
  while (count < kMaxBuckets && count * kCellsPerBucket < valid_cells) count *= 2;
  return count;
}

int roundedUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

template <typename Scalar>
MEMS_STICTION_INLINE void findBucketsOf(const StoredGaps<Scalar>& gaps, std::ptrdiff_t first,
                                        std::size_t size, double inverse_width, double last,
                                        std::int32_t* buckets) {
  const Scalar* relief = gaps.relief + first;
  const double top = gaps.top;
  for (std::size_t i = 0; i < size; ++i) {
    const double in_widths = (top - static_cast<double>(relief[i])) * inverse_width;
    buckets[i] = static_cast<std::int32_t>(in_widths < last ? in_widths : last);
  }
}

MEMS_STICTION_VECTORIZED void findBuckets(const StoredGaps<float>& gaps, std::ptrdiff_t first,
                                          std::size_t size, double inverse_width, double last,
                                          std::int32_t* buckets) {
  findBucketsOf(gaps, first, size, inverse_width, last, buckets);
}
MEMS_STICTION_VECTORIZED void findBuckets(const StoredGaps<double>& gaps, std::ptrdiff_t first,
                                          std::size_t size, double inverse_width, double last,
                                          std::int32_t* buckets) {
  findBucketsOf(gaps, first, size, inverse_width, last, buckets);
}

}  // namespace

void GapOrder::build(const GapField& field, double max_contact_fraction, double step,
                     DaleMap* dales) {
  dales_ = dales;
  chooseBuckets(field, step);
  countGaps(field);
  ordered_buckets_ = 0;
  group_end_.clear();
  is_sorted_.clear();
  ordered_moments_.clear();
  orderUpTo(field, wantedCells(field, max_contact_fraction));
}

void GapOrder::extend(const GapField& field, double max_contact_fraction) {
  orderUpTo(field, wantedCells(field, max_contact_fraction));
}

int GapOrder::wantedCells(const GapField& field, double max_contact_fraction) const {
  return std::clamp(static_cast<int>(std::ceil(max_contact_fraction * field.validCount())), 1,
                    field.validCount());
}

void GapOrder::orderUpTo(const GapField& field, int wanted) {
  const int first_bucket = ordered_buckets_;
  chooseOrderedBuckets(wanted);
  measureTail();
  collectCells(field, first_bucket);
  findContactLimit(wanted);
}

void GapOrder::chooseBuckets(const GapField& field, double step) {
  const int wanted_buckets = bucketCountFor(field.validCount());
  // a frame without relief has one bucket of any width; a denormal range would overflow the inverse
  const double range = std::max(field.largestGap(), 1e-200);
  const double steps = step > 0.0 ? std::floor(range / step) + 1.0 : kMaxBuckets + 1.0;
  groups_are_steps_ = steps <= kMaxBuckets;
  group_shift_ = 0;
  if (groups_are_steps_) {
    while (std::ldexp(steps, group_shift_ + 1) <= wanted_buckets) ++group_shift_;
    group_width_ = step;
    bucket_width_ = std::ldexp(step, -group_shift_);
    bucket_count_ = static_cast<int>(std::ldexp(steps, group_shift_));
  } else {
    group_width_ = bucket_width_ = range / wanted_buckets;
    bucket_count_ = wanted_buckets;
  }
  bucket_count_ = roundedUp(bucket_count_, std::max(kBucketsPerTailBucket, 1 << group_shift_));
  inverse_width_ = 1.0 / bucket_width_;
}

void GapOrder::countGaps(const GapField& field) {
  bucket_count_of_.assign(static_cast<std::size_t>(bucket_count_), 0);
  const auto cols = static_cast<std::size_t>(field.cols());
  row_buckets_.resize(cols);
  std::int32_t* count = bucket_count_of_.data();
  field.readGaps([&](const auto& gaps) {
    for (int row = 0; row < field.rows(); ++row) {
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(row) * field.cols();
      findBuckets(gaps, first, cols, inverse_width_, bucket_count_ - 1, row_buckets_.data());
      for (const std::int32_t bucket : row_buckets_) ++count[bucket];
    }
  });
  bucket_count_of_.back() -=
      field.cellCount() - field.validCount();  // infinite gaps were counted there
}

void GapOrder::chooseOrderedBuckets(int wanted) {
  int total = 0;
  int bucket = 0;
  while (total < wanted) total += bucket_count_of_[static_cast<std::size_t>(bucket++)];
  const int wanted_buckets = std::min(
      roundedUp(bucket + kBucketsBeyondLimit, std::max(kBucketsPerTailBucket, 1 << group_shift_)),
      bucket_count_);
  ordered_buckets_ = std::max(ordered_buckets_, wanted_buckets);
}

void GapOrder::measureTail() {
  tail_moments_.assign(
      static_cast<std::size_t>((bucket_count_ - ordered_buckets_) / kBucketsPerTailBucket), {});
  int bucket = ordered_buckets_;
  for (GapMoments& moments : tail_moments_) {
    const double lower_end = bucket * bucket_width_;
    for (int i = 0; i < kBucketsPerTailBucket; ++i, ++bucket) {
      addGaps(moments, bucket_count_of_[static_cast<std::size_t>(bucket)],
              (i + 0.5) * bucket_width_);
    }
    finishMoments(moments, lower_end);
  }
}

void GapOrder::sortGroup(int group) {
  std::uint8_t& is_sorted = is_sorted_[static_cast<std::size_t>(group)];
  if (is_sorted != 0) return;
  const auto comes_before = [](const OrderedCell& a, const OrderedCell& b) {
    return comesBefore(a.gap, a.cell, b.gap, b.cell);
  };
  const auto begin = cells_.begin() + groupStart(group);
  const auto end = cells_.begin() + group_end_[static_cast<std::size_t>(group)];
  // cells of one gap are in order already: a plateau may be the whole frame
  if (!std::is_sorted(begin, end, comes_before)) std::sort(begin, end, comes_before);
  is_sorted = 1;
}

void GapOrder::findContactLimit(int wanted) {
  const int limit_group = groupOfPlace(wanted - 1);
  sortGroup(limit_group);
  contact_limit_ = wanted;
  const double limit_gap = cells_[static_cast<std::size_t>(wanted - 1)].gap;
  while (contact_limit_ < group_end_[static_cast<std::size_t>(limit_group)] &&
         cells_[static_cast<std::size_t>(contact_limit_)].gap == limit_gap) {
    ++contact_limit_;
  }
}

int GapOrder::groupOfPlace(int place) const {
  const auto end = std::upper_bound(group_end_.begin(), group_end_.end(), place);
  return static_cast<int>(end - group_end_.begin());
}

int GapOrder::sortBelow(double approach) {
  const int group_count = groupCount();
  if (approach >= group_count * group_width_ && ordered_buckets_ < bucket_count_) {
    return static_cast<int>(cells_.size());
  }
  const double group_of_approach =
      std::min<double>(std::round(approach / group_width_), group_count);
  if (groups_are_steps_ && group_of_approach * group_width_ == approach) {
    return groupStart(static_cast<int>(group_of_approach));
  }
  const int group = std::min(bucketOf(approach) >> group_shift_, group_count - 1);
  sortGroup(group);
  const auto begin = cells_.begin() + groupStart(group);
  const auto first_apart =
      std::partition_point(begin, cells_.begin() + group_end_[static_cast<std::size_t>(group)],
                           [approach](const OrderedCell& cell) { return cell.gap < approach; });
  return static_cast<int>(first_apart - cells_.begin());
}

double GapOrder::cellsBelow(double limit) const {
  const double limit_in_widths = limit * inverse_width_;
  if (limit_in_widths < ordered_buckets_) {
    const int group = static_cast<int>(std::max(limit_in_widths, 0.0)) >> group_shift_;
    const auto begin = cells_.begin() + groupStart(group);
    const auto end = cells_.begin() + group_end_[static_cast<std::size_t>(group)];
    return static_cast<double>(
        groupStart(group) +
        std::count_if(begin, end, [limit](const OrderedCell& cell) { return cell.gap < limit; }));
  }
  auto count = static_cast<double>(cells_.size());
  for (int bucket = ordered_buckets_; bucket < bucket_count_ && bucket < limit_in_widths;
       ++bucket) {
    // the largest gap is the last bucket's upper end, and below any limit past it
    const double covered = std::min(limit_in_widths - bucket, 1.0);
    count += covered * bucket_count_of_[static_cast<std::size_t>(bucket)];
  }
  return count;
}

double GapOrder::lowerEndAt(int place) const {
  int before = 0;
  int bucket = 0;
  while (bucket + 1 < bucket_count_ &&
         before + bucket_count_of_[static_cast<std::size_t>(bucket)] <= place) {
    before += bucket_count_of_[static_cast<std::size_t>(bucket++)];
  }
  return bucket * bucket_width_;
}

void GapOrder::sortBetween(int begin, int end) {
  for (int group = groupOfPlace(begin); group < groupCount(); ++group) {
    if (groupStart(group) >= end) break;
    sortGroup(group);
  }
}

int GapOrder::groupStartFrom(int bucket) const {
  return std::min(roundedUp(bucket, 1 << group_shift_), ordered_buckets_);
}

int GapOrder::cellsBefore(int group_start_bucket) const {
  return groupStart(group_start_bucket >> group_shift_);
}

}  // namespace mems_stiction
