#include "numeric/median.hpp"

#include <cmath>

#include "numeric/value_range.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kFew = 48;     ///< values that are sorted out at once
constexpr std::size_t kBlock = 256;  ///< values whose buckets are computed side by side
constexpr std::size_t kWays =
    4;  ///< counts of each bucket: neighbours often share one, and would wait for each other
constexpr int kRounds = 8;  ///< values that the buckets have not parted by then are sorted out

/// The bucket of each value. NaN is behind the last.
MEMS_STICTION_VECTORIZED void findBuckets(const double* values, std::size_t size, double low,
                                          double per_unit, double outside, std::int32_t* found) {
  for (std::size_t i = 0; i < size; ++i) {
    const double place = (values[i] - low) * per_unit;
    found[i] = static_cast<std::int32_t>(place < outside ? place : outside);
  }
}

}  // namespace

double MedianFinder::median(const double* values, std::size_t size) {
  Ranks ranks;
  candidates_.reserve(size);  // however many there come to be
  for (int round = 0; round < kRounds; ++round) {
    ValueRange range;
    addToRange(values, size, range);
    if (round == 0) {
      if (range.count == 0) return 0.0;
      const auto count = static_cast<std::size_t>(range.count);
      ranks = {(count - 1) / 2, count / 2};
    }
    if (range.lowest == range.highest) return range.lowest;
    Buckets buckets;
    buckets.count = static_cast<std::int32_t>(std::clamp<std::size_t>(size / 4, 64, 4096));
    buckets.low = range.lowest;
    buckets.per_unit = (buckets.count - 0.5) / (range.highest - range.lowest);
    if (size <= kFew || !std::isnormal(buckets.per_unit)) break;
    const BucketSpan span = bucketsOf(ranks, values, size, buckets);
    size = collect(values, size, buckets, span);
    values = candidates_.data();
  }
  size = collect(values, size, Buckets{0.0, 0.0, 1}, BucketSpan{});
  double* first = candidates_.data();
  double* upper = first + ranks.upper;
  std::nth_element(first, upper, first + size);
  return ranks.lower == ranks.upper ? *upper : 0.5 * (*upper + *std::max_element(first, upper));
}

MedianFinder::BucketSpan MedianFinder::bucketsOf(Ranks& ranks, const double* values,
                                                 std::size_t size, const Buckets& buckets) {
  counts_.assign(kWays * static_cast<std::size_t>(buckets.count + 1), 0);
  std::int32_t found[kBlock];
  for (std::size_t start = 0; start < size; start += kBlock) {
    const std::size_t length = std::min(kBlock, size - start);
    findBuckets(values + start, length, buckets.low, buckets.per_unit, buckets.count, found);
    for (std::size_t i = 0; i < length; ++i)
      ++counts_[kWays * static_cast<std::size_t>(found[i]) + i % kWays];
  }
  const auto countIn = [&](std::int32_t bucket) {
    const std::uint32_t* ways = &counts_[kWays * static_cast<std::size_t>(bucket)];
    return std::size_t{ways[0]} + ways[1] + ways[2] + ways[3];
  };
  BucketSpan span;
  std::size_t before = 0;
  for (; before + countIn(span.first) <= ranks.lower; ++span.first) before += countIn(span.first);
  span.last = span.first;
  for (std::size_t until = before + countIn(span.last); until <= ranks.upper;)
    until += countIn(++span.last);
  ranks = {ranks.lower - before, ranks.upper - before};
  return span;
}

std::size_t MedianFinder::collect(const double* values, std::size_t size, const Buckets& buckets,
                                  const BucketSpan& span) {
  std::int32_t found[kBlock];
  const auto width = static_cast<std::uint32_t>(span.last - span.first);
  std::size_t count = 0;
  for (std::size_t start = 0; start < size; start += kBlock) {
    const std::size_t length = std::min(kBlock, size - start);
    // Where the values are the candidates themselves, they are read before they are written over.
    if (candidates_.size() < count + length) candidates_.resize(count + length);
    findBuckets(values + start, length, buckets.low, buckets.per_unit, buckets.count, found);
    for (std::size_t i = 0; i < length; ++i) {
      // One comparison, which is rarely true: two would be guessed wrong every other time.
      if (static_cast<std::uint32_t>(found[i] - span.first) <= width)
        candidates_[count++] = values[start + i];
    }
  }
  return count;
}

}  // namespace mems_stiction
