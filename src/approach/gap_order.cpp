#include "mems_stiction/approach/gap_order.hpp"

#include <algorithm>
#include <cmath>

namespace mems_stiction {
namespace {

constexpr int kMaxBuckets = 1 << 16;
constexpr int kMinBuckets = 1 << 6;
constexpr int kCellsPerBucket = 8;
/// Buckets beyond the contact limit that are sorted too, so that the nearest cells out of contact can be summed
/// directly.
constexpr int kBucketsBeyondLimit = 64;

int bucketCountFor(int valid_cells) {
  int count = kMinBuckets;
  while (count < kMaxBuckets && count * kCellsPerBucket < valid_cells) count *= 2;
  return count;
}

bool comesFirst(const OrderedCell& a, const OrderedCell& b) {
  return a.gap < b.gap || (a.gap == b.gap && a.cell < b.cell);
}

}  // namespace

int GapOrder::bucketOf(double gap) const {
  return std::min(static_cast<int>(gap * inverse_width_), static_cast<int>(buckets_.size()) - 1);
}

void GapOrder::build(const GapField& field, double max_contact_fraction) {
  const int bucket_count = bucketCountFor(field.validCount());
  // a frame without relief has one bucket of any width; a denormal range would overflow the inverse
  bucket_width_ = std::max(field.largestGap(), 1e-200) / bucket_count;
  inverse_width_ = 1.0 / bucket_width_;
  buckets_.assign(static_cast<std::size_t>(bucket_count), GapMoments());
  bucket_end_.assign(static_cast<std::size_t>(bucket_count), 0);

  // moments about the bucket's lower end: no digits are lost to the size of the gap
  for (const double gap : field.gaps()) {
    if (gap == GapField::kInvalidGap) continue;
    const int bucket = bucketOf(gap);
    GapMoments& moments = buckets_[static_cast<std::size_t>(bucket)];
    const double excess = gap - bucket * bucket_width_;
    moments.count += 1.0;
    moments.mean += excess;
    moments.variance += excess * excess;
  }
  int total = 0;
  for (int bucket = 0; bucket < bucket_count; ++bucket) {
    GapMoments& moments = buckets_[static_cast<std::size_t>(bucket)];
    total += static_cast<int>(moments.count);
    bucket_end_[static_cast<std::size_t>(bucket)] = total;
    if (moments.count == 0.0) continue;
    const double mean_excess = moments.mean / moments.count;
    moments.variance = std::max(0.0, moments.variance / moments.count - mean_excess * mean_excess);
    moments.mean = bucket * bucket_width_ + mean_excess;
  }

  const int wanted =
      std::clamp(static_cast<int>(std::ceil(max_contact_fraction * field.validCount())), 1, field.validCount());
  const int limit_bucket =
      static_cast<int>(std::lower_bound(bucket_end_.begin(), bucket_end_.end(), wanted) - bucket_end_.begin());
  ordered_buckets_ = std::min(limit_bucket + 1 + kBucketsBeyondLimit, bucket_count);

  cells_.resize(static_cast<std::size_t>(bucket_end_[static_cast<std::size_t>(ordered_buckets_ - 1)]));
  for (int bucket = ordered_buckets_ - 1; bucket > 0; --bucket) {  // ends become starts, and ends again while filling
    bucket_end_[static_cast<std::size_t>(bucket)] = bucket_end_[static_cast<std::size_t>(bucket - 1)];
  }
  bucket_end_[0] = 0;
  const std::vector<double>& gaps = field.gaps();
  for (std::size_t cell = 0; cell < gaps.size(); ++cell) {
    if (gaps[cell] == GapField::kInvalidGap) continue;
    const int bucket = bucketOf(gaps[cell]);
    if (bucket >= ordered_buckets_) continue;
    const std::int32_t place = bucket_end_[static_cast<std::size_t>(bucket)]++;
    cells_[static_cast<std::size_t>(place)] = {gaps[cell], static_cast<std::int32_t>(cell)};
  }
  int start = 0;
  for (int bucket = 0; bucket < ordered_buckets_; ++bucket) {
    const int end = bucket_end_[static_cast<std::size_t>(bucket)];
    if (end - start > 1) std::sort(cells_.begin() + start, cells_.begin() + end, comesFirst);
    start = end;
  }

  contact_limit_ = wanted;
  while (contact_limit_ < static_cast<int>(cells_.size()) &&
         cells_[static_cast<std::size_t>(contact_limit_)].gap == cells_[static_cast<std::size_t>(wanted - 1)].gap) {
    ++contact_limit_;
  }
}

int GapOrder::countBelow(double approach) const {
  const auto first_apart = std::partition_point(cells_.begin(), cells_.end(),
                                                [approach](const OrderedCell& cell) { return cell.gap < approach; });
  return static_cast<int>(first_apart - cells_.begin());
}

int GapOrder::endOfBucket(int bucket) const {
  return bucket < ordered_buckets_ ? bucket_end_[static_cast<std::size_t>(bucket)] : static_cast<int>(cells_.size());
}

}  // namespace mems_stiction
