#include "mems_stiction/approach/gap_order.hpp"

#include <algorithm>
#include <cmath>

namespace mems_stiction {
namespace {

constexpr int kMaxBuckets = 1 << 16;
constexpr int kMinBuckets = 1 << 6;
constexpr int kCellsPerBucket = 8;
/// Buckets beyond the contact limit that are ordered too: cells near the contact are summed one by one, and the wider
/// buckets of the tail start where their width is small against the gap.
constexpr int kBucketsBeyondLimit = 16 * GapOrder::kBucketsPerTailBucket;

int bucketCountFor(int valid_cells) {
  int count = kMinBuckets;
  while (count < kMaxBuckets && count * kCellsPerBucket < valid_cells) count *= 2;
  return count;
}

bool comesFirst(const OrderedCell& a, const OrderedCell& b) {
  return a.gap < b.gap || (a.gap == b.gap && a.cell < b.cell);
}

/// Sums of gaps about the bucket's lower end become moments; no digits are lost to the size of the gap.
void finishMoments(GapMoments& moments, double lower_end) {
  if (moments.count == 0.0) return;
  const double mean_excess = moments.mean / moments.count;
  moments.variance = std::max(0.0, moments.variance / moments.count - mean_excess * mean_excess);
  moments.mean = lower_end + mean_excess;
}

void addGap(GapMoments& moments, double excess) {
  moments.count += 1.0;
  moments.mean += excess;
  moments.variance += excess * excess;
}

}  // namespace

int GapOrder::bucketOf(double gap) const {
  return static_cast<int>(std::min(gap * inverse_width_, bucket_count_ - 1.0));
}

void GapOrder::build(const GapField& field, double max_contact_fraction) {
  bucket_count_ = bucketCountFor(field.validCount());
  // a frame without relief has one bucket of any width; a denormal range would overflow the inverse
  bucket_width_ = std::max(field.largestGap(), 1e-200) / bucket_count_;
  inverse_width_ = 1.0 / bucket_width_;
  countGaps(field);
  const int wanted =
      std::clamp(static_cast<int>(std::ceil(max_contact_fraction * field.validCount())), 1, field.validCount());
  chooseOrderedBuckets(wanted);
  measureTail();
  collectCells(field);
  measureOrderedBuckets();

  is_sorted_.assign(static_cast<std::size_t>(ordered_buckets_), 0);
  const int limit_bucket =
      static_cast<int>(std::lower_bound(bucket_end_.begin(), bucket_end_.end(), wanted) - bucket_end_.begin());
  sortBucket(limit_bucket);
  contact_limit_ = wanted;
  const double limit_gap = cells_[static_cast<std::size_t>(wanted - 1)].gap;
  while (contact_limit_ < endOfBucket(limit_bucket) &&
         cells_[static_cast<std::size_t>(contact_limit_)].gap == limit_gap) {
    ++contact_limit_;
  }
}

void GapOrder::countGaps(const GapField& field) {
  bucket_end_.assign(static_cast<std::size_t>(bucket_count_), 0);
  const double last = bucket_count_ - 1;
  std::int32_t* count = bucket_end_.data();
  for (const double gap : field.gaps()) ++count[static_cast<int>(std::min(gap * inverse_width_, last))];
  bucket_end_.back() -= field.cellCount() - field.validCount();  // infinite gaps were counted there
}

void GapOrder::chooseOrderedBuckets(int wanted) {
  int total = 0;
  int bucket = 0;
  while (total < wanted) total += bucket_end_[static_cast<std::size_t>(bucket++)];
  const int beyond = bucket + kBucketsBeyondLimit;
  const int rounded = (beyond + kBucketsPerTailBucket - 1) / kBucketsPerTailBucket * kBucketsPerTailBucket;
  ordered_buckets_ = std::min(rounded, bucket_count_);
}

void GapOrder::measureTail() {
  tail_moments_.assign(static_cast<std::size_t>((bucket_count_ - ordered_buckets_) / kBucketsPerTailBucket), {});
  int bucket = ordered_buckets_;
  for (GapMoments& moments : tail_moments_) {
    const double lower_end = bucket * bucket_width_;
    for (int i = 0; i < kBucketsPerTailBucket; ++i, ++bucket) {
      const double count = bucket_end_[static_cast<std::size_t>(bucket)];
      const double excess = (i + 0.5) * bucket_width_;
      moments.count += count;
      moments.mean += count * excess;
      moments.variance += count * excess * excess;
    }
    finishMoments(moments, lower_end);
  }
}

void GapOrder::collectCells(const GapField& field) {
  int start = 0;
  for (int bucket = 0; bucket < ordered_buckets_; ++bucket) {
    std::int32_t& place = bucket_end_[static_cast<std::size_t>(bucket)];
    const int count = place;
    place = start;  // becomes the bucket's end while it is filled
    start += count;
  }
  bucket_end_.resize(static_cast<std::size_t>(ordered_buckets_));
  cells_.resize(static_cast<std::size_t>(start));

  // which cells come in is random along a row: written without a branch, then put into their buckets
  const auto cols = static_cast<std::size_t>(field.cols());
  near_cells_.resize(cols);
  const double bound = ordered_buckets_ < bucket_count_ ? ordered_buckets_ : GapField::kInvalidGap;
  const double* gap = field.gaps().data();
  for (std::int32_t row = 0; row < field.rows(); ++row, gap += cols) {
    std::size_t near_count = 0;
    for (std::size_t col = 0; col < cols; ++col) {
      near_cells_[near_count] = static_cast<std::int32_t>(col);
      near_count += gap[col] * inverse_width_ < bound ? 1 : 0;
    }
    for (std::size_t i = 0; i < near_count; ++i) {
      const std::int32_t col = near_cells_[i];
      const double cell_gap = gap[col];
      const std::int32_t place = bucket_end_[static_cast<std::size_t>(bucketOf(cell_gap))]++;
      cells_[static_cast<std::size_t>(place)] = {cell_gap, static_cast<std::int32_t>(row * cols) + col, row};
    }
  }
}

void GapOrder::measureOrderedBuckets() {
  ordered_moments_.assign(static_cast<std::size_t>(ordered_buckets_), {});
  int place = 0;
  for (int bucket = 0; bucket < ordered_buckets_; ++bucket) {
    GapMoments& moments = ordered_moments_[static_cast<std::size_t>(bucket)];
    const double lower_end = bucket * bucket_width_;
    for (; place < endOfBucket(bucket); ++place)
      addGap(moments, cells_[static_cast<std::size_t>(place)].gap - lower_end);
    finishMoments(moments, lower_end);
  }
}

void GapOrder::sortBucket(int bucket) {
  std::uint8_t& is_sorted = is_sorted_[static_cast<std::size_t>(bucket)];
  if (is_sorted != 0) return;
  const int begin = bucket == 0 ? 0 : endOfBucket(bucket - 1);
  std::sort(cells_.begin() + begin, cells_.begin() + endOfBucket(bucket), comesFirst);
  is_sorted = 1;
}

int GapOrder::countBelow(double approach) {
  const double bucket_of_approach = approach * inverse_width_;
  if (bucket_of_approach >= ordered_buckets_ && ordered_buckets_ < bucket_count_)
    return static_cast<int>(cells_.size());
  const int bucket =
      std::min(static_cast<int>(std::min<double>(bucket_of_approach, bucket_count_)), ordered_buckets_ - 1);
  sortBucket(bucket);
  const auto begin = cells_.begin() + (bucket == 0 ? 0 : endOfBucket(bucket - 1));
  const auto first_apart = std::partition_point(begin, cells_.begin() + endOfBucket(bucket),
                                                [approach](const OrderedCell& cell) { return cell.gap < approach; });
  return static_cast<int>(first_apart - cells_.begin());
}

void GapOrder::sortBetween(int begin, int end) {
  const auto first_past = std::upper_bound(bucket_end_.begin(), bucket_end_.end(), begin);
  for (auto bucket = static_cast<int>(first_past - bucket_end_.begin()); bucket < ordered_buckets_; ++bucket) {
    if ((bucket == 0 ? 0 : endOfBucket(bucket - 1)) >= end) break;
    sortBucket(bucket);
  }
}

}  // namespace mems_stiction
