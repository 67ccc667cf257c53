#include "approach/height_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/byte_pieces.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr double kPerMetre = 549755813888.0;  // 2^39
/// Added to a number below 2^51 and taken away again, it leaves the nearest whole one.
constexpr double kRounding = 6755399441055744.0;  // 1.5 * 2^52
/// Room on either side of the heights that have been counted.
constexpr std::int64_t kLeastRoom = 1 << 10;
constexpr unsigned kMostShift = 40;

MEMS_STICTION_INLINE double nearestFinest(double height) {
  return height * kPerMetre + kRounding - kRounding;
}

/// @return whether a height lies elsewhere than in `count` buckets of 1/inverse_width finest ones
/// from the finest one `first` on
template <typename Scalar>
MEMS_STICTION_INLINE bool findSlotsOf(const Scalar* line, std::size_t size, double first,
                                      double inverse_width, double count, std::int32_t* slots) {
  std::int32_t is_any_outside = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto height = static_cast<double>(line[i]);
    const double place = (nearestFinest(height) - first) * inverse_width;
    const double inside = place >= 0.0 && place < count ? place : -1.0;
    const std::int32_t slot = static_cast<std::int32_t>(inside) + (inside >= 0.0 ? 1 : 0);
    slots[i] = slot < 0 ? 0 : slot;
    is_any_outside |= (inside < 0.0 ? 1 : 0) & (height - height == 0.0 ? 1 : 0);
  }
  return is_any_outside != 0;
}

MEMS_STICTION_VECTORIZED bool findSlots(const float* line, std::size_t size, double first,
                                        double inverse_width, double count, std::int32_t* slots) {
  return findSlotsOf(line, size, first, inverse_width, count, slots);
}
MEMS_STICTION_VECTORIZED bool findSlots(const double* line, std::size_t size, double first,
                                        double inverse_width, double count, std::int32_t* slots) {
  return findSlotsOf(line, size, first, inverse_width, count, slots);
}

}  // namespace

std::int64_t HeightCounts::finestOf(double height) {
  return static_cast<std::int64_t>(
      nearestFinest(std::clamp(height, -kLargestHeight, kLargestHeight)));
}

double HeightCounts::width() const { return std::ldexp(1.0 / kPerMetre, static_cast<int>(shift_)); }

double HeightCounts::lowerEnd(std::int64_t bucket) const {
  return (static_cast<double>(finestOfBucket(bucket)) - 0.5) / kPerMetre;
}

double HeightCounts::centre(std::int64_t bucket) const {
  return 0.5 * (static_cast<double>(finestOfBucket(bucket) + finestOfBucket(bucket + 1)) - 1.0) /
         kPerMetre;
}

std::int64_t HeightCounts::lowest() const {
  const auto found = std::find_if(counts_.begin() + 1, counts_.end(),
                                  [](std::int64_t count) { return count > 0; });
  return first_ + (found - counts_.begin()) - 1;
}

std::int64_t HeightCounts::highest() const {
  const auto found = std::find_if(counts_.rbegin(), counts_.rend() - 1,
                                  [](std::int64_t count) { return count > 0; });
  return first_ + (counts_.rend() - found) - 2;
}

std::int64_t HeightCounts::countOf(std::int64_t bucket) const {
  const std::int64_t slot = slotOf(bucket);
  return slot >= 1 && slot <= bucketCount() ? counts_[static_cast<std::size_t>(slot)] : 0;
}

std::int64_t HeightCounts::countFrom(std::int64_t bucket) const {
  std::int64_t sum = 0;
  for (std::int64_t slot = std::max<std::int64_t>(slotOf(bucket), 1); slot <= bucketCount();
       ++slot) {
    sum += counts_[static_cast<std::size_t>(slot)];
  }
  return sum;
}

std::int64_t HeightCounts::lowestWithin(std::int64_t most_heights) const {
  std::int64_t slot = bucketCount();
  std::int64_t sum = 0;
  while (slot >= 1) {
    sum += counts_[static_cast<std::size_t>(slot)];
    if (sum > most_heights) break;
    --slot;
  }
  return slot == 0 ? lowest() : first_ + slot;
}

template <typename Scalar>
void HeightCounts::addRow(const Scalar* line, std::size_t size, std::int32_t* slots) {
  const auto find = [&] {
    return findSlots(line, size, static_cast<double>(finestOfBucket(first_)),
                     std::ldexp(1.0, -static_cast<int>(shift_)), static_cast<double>(bucketCount()),
                     slots);
  };
  if (find()) {
    growToRow(line, size);
    find();
  }
  std::int64_t* const counts = counts_.data();
  counts[0] = 0;
  for (std::size_t i = 0; i < size; ++i) ++counts[slots[i]];
  total_ += static_cast<std::int64_t>(size) - counts[0];
}

void HeightCounts::add(const float* line, std::size_t size, std::int32_t* slots) {
  addRow(line, size, slots);
}
void HeightCounts::add(const double* line, std::size_t size, std::int32_t* slots) {
  addRow(line, size, slots);
}

template <typename Scalar>
void HeightCounts::growToRow(const Scalar* line, std::size_t size) {
  double lowest_height = std::numeric_limits<double>::infinity();
  double highest_height = -lowest_height;
  for (std::size_t i = 0; i < size; ++i) {
    const double height = line[i];
    if (!std::isfinite(height)) continue;
    if (std::abs(height) > kLargestHeight) {
      throw SurfaceError("a height of " + numberText(height) +
                         " m is not allowed: heights must lie within " +
                         numberText(kLargestHeight) + " m of zero");
    }
    lowest_height = std::min(lowest_height, height);
    highest_height = std::max(highest_height, height);
  }
  growTo(finestOf(lowest_height), finestOf(highest_height));
}

void HeightCounts::growTo(std::int64_t lowest_finest, std::int64_t highest_finest) {
  const bool was_empty = empty();
  const std::int64_t old_lowest = was_empty ? lowest_finest >> shift_ : lowest();
  const std::int64_t old_highest = was_empty ? highest_finest >> shift_ : highest();
  unsigned shift = shift_;
  std::int64_t lowest_bucket = 0;
  std::int64_t highest_bucket = 0;
  for (;; ++shift) {
    lowest_bucket = std::min(lowest_finest >> shift, old_lowest >> (shift - shift_));
    highest_bucket = std::max(highest_finest >> shift, old_highest >> (shift - shift_));
    if (highest_bucket - lowest_bucket < kMostBuckets) break;
  }
  const std::int64_t range = highest_bucket - lowest_bucket + 1;
  // no more than kMostBuckets ever: what lies beyond them makes them wider
  const std::int64_t room = std::min(kLeastRoom + range / 2, (kMostBuckets - range) / 2);
  const std::int64_t first = lowest_bucket - room;
  std::vector<std::int64_t> counts(static_cast<std::size_t>(range + 2 * room + 1), 0);
  for (std::int64_t bucket = old_lowest; bucket <= old_highest && !was_empty; ++bucket) {
    counts[static_cast<std::size_t>((bucket >> (shift - shift_)) - first + 1)] += countOf(bucket);
  }
  shift_ = shift;
  first_ = first;
  counts_.swap(counts);
}

void HeightCounts::add(const HeightCounts& other) {
  if (other.empty()) return;
  if (other.shift_ > shift_) {  // as wide ones as the other's
    HeightCounts wider = other;
    wider.add(*this);
    *this = std::move(wider);
    return;
  }
  const std::int64_t other_lowest = other.lowest();
  const std::int64_t other_highest = other.highest();
  growTo(other.finestOfBucket(other_lowest), other.finestOfBucket(other_highest));
  for (std::int64_t bucket = other_lowest; bucket <= other_highest; ++bucket) {
    const std::int64_t slot = slotOf(other.finestOfBucket(bucket) >> shift_);
    counts_[static_cast<std::size_t>(slot)] += other.countOf(bucket);
  }
  total_ += other.total_;
}

void HeightCounts::appendTo(std::string& bytes) const {
  const std::int64_t from = empty() ? 0 : lowest();
  const std::int64_t size = empty() ? 0 : highest() - from + 1;
  appendBytes(bytes, shift_);
  appendBytes(bytes, from);
  appendBytes(bytes, size);
  for (std::int64_t i = 0; i < size; ++i) appendBytes(bytes, countOf(from + i));
}

HeightCounts HeightCounts::takeFrom(std::string_view& bytes) {
  HeightCounts counts;
  std::int64_t size = 0;
  bool is_whole =
      takeBytes(bytes, counts.shift_) && takeBytes(bytes, counts.first_) && takeBytes(bytes, size);
  is_whole = is_whole && counts.shift_ <= kMostShift && size >= 0 && size <= kMostBuckets;
  if (is_whole) counts.counts_.resize(static_cast<std::size_t>(size) + 1, 0);
  for (std::int64_t i = 1; is_whole && i <= size; ++i) {
    std::int64_t& count = counts.counts_[static_cast<std::size_t>(i)];
    is_whole = takeBytes(bytes, count) && count >= 0;
    counts.total_ += count;
  }
  const std::int64_t end = is_whole ? counts.finestOfBucket(1) : 1;
  const std::int64_t farthest = finestOf(kLargestHeight) / end + 1;
  if (!is_whole || counts.first_ < -farthest || counts.first_ + size > farthest + 1) {
    throw SurfaceError("these bytes hold no heights that were counted");
  }
  return counts;
}

}  // namespace mems_stiction
