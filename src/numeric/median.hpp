#pragma once

/// @file
/// Medians of a few numbers, and of many.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mems_stiction {

/// Median; the mean of the two middle values for an even number, 0 for none. Reorders the values,
/// takes linear time.
inline double medianOf(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// The same medians for many values, in memory that is used again: a nanosecond or two for each
/// value. They are counted into buckets of equal width between the smallest and the largest; those
/// of the median's bucket are what the search goes on with. Which way values are spread decides how
/// fast it goes, never what is found.
class MedianFinder {
 public:
  /// Median of the values that are not NaN, all finite; the mean of the two middle values for an
  /// even number, 0 for none. Leaves them in their places.
  double median(const double* values, std::size_t size);

 private:
  /// Equal parts of a range of values.
  struct Buckets {
    double low = 0.0;
    double per_unit = 0.0;
    std::int32_t count = 0;
  };
  /// From the first bucket to the last, both included.
  struct BucketSpan {
    std::int32_t first = 0;
    std::int32_t last = 0;
  };
  /// Of the one or two middle values among the others, from 0.
  struct Ranks {
    std::size_t lower = 0;
    std::size_t upper = 0;
  };

  /// The buckets that contain the values of these ranks; the ranks become those within the buckets.
  BucketSpan bucketsOf(Ranks& ranks, const double* values, std::size_t size,
                       const Buckets& buckets);
  /// Makes the values of these buckets the candidates, and says how many they are. NaN never is
  /// one.
  std::size_t collect(const double* values, std::size_t size, const Buckets& buckets,
                      const BucketSpan& span);

  std::vector<std::uint32_t> counts_;  ///< of each bucket
  std::vector<double> candidates_;     ///< values among which the median is
};

}  // namespace mems_stiction
