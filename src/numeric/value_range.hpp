#pragma once

#include <cstddef>
#include <limits>

namespace mems_stiction {

/// What the values that are not NaN span, and how many they are.
struct ValueRange {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  long long count = 0;
};

void addToRange(const double* values, std::size_t size, ValueRange& range);

}  // namespace mems_stiction
