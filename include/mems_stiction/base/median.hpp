#pragma once

#include <algorithm>
#include <vector>

namespace mems_stiction {

/// Median; the mean of the two middle values for an even number, 0 for none. Reorders the values, takes linear time.
inline double medianOf(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace mems_stiction
