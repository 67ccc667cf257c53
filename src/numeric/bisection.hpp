#pragma once

/// @file
/// Where does a function change its sign?

#include <cmath>

namespace mems_stiction {

/// A place between `low` and `high` where the sign changes, by bisection.
/// - @p function of a double, of different signs at both ends; the sign at `low` is the one that
///   stays there
/// - @p tolerance of the place, relative to the larger of both ends' sizes [-]
template <typename Function>
double signChange(double low, double high, double tolerance, const Function& function) {
  const bool is_positive = function(low) > 0.0;
  const double scale = std::fmax(std::abs(low), std::abs(high));
  while (high - low > tolerance * scale) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    ((function(middle) > 0.0) == is_positive ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace mems_stiction
