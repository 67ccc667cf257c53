#pragma once

/// @file
/// Mean and scatter of a few values.

#include <cmath>
#include <vector>

namespace mems_stiction {

/// NaN of none.
inline double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Sum of the squares of their distances from a value.
inline double squaresAbout(double value, const std::vector<double>& values) {
  double sum = 0.0;
  for (const double other : values) sum += (other - value) * (other - value);
  return sum;
}

/// Standard deviation of what they are a sample of, with n - 1; of two or more.
inline double deviationOf(const std::vector<double>& values) {
  return std::sqrt(squaresAbout(meanOf(values), values) / static_cast<double>(values.size() - 1));
}

}  // namespace mems_stiction
