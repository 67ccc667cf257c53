#pragma once

/// @file
/// Does one stated quantity exceed another, or is it the rounding of both? 250e-6 + 50e-6 is above
/// 300e-6 in the last digit. And round numbers for people.

#include <cmath>

namespace mems_stiction {

/// Of quantities that were typed, or are sums and products of a few of them [-].
inline constexpr double kRounding = 1e-9;

/// Whether it exceeds the limit by more than rounding does.
/// - @p limit >= 0, in the unit of the value
inline bool exceeds(double value, double limit) { return value > limit * (1.0 + kRounding); }

/// The largest of 1, 2, 5, 10, 20, ... that is not above the value.
inline double roundedDown(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0}) {
    if (value >= digit * decade) return digit * decade;
  }
  return decade;
}

}  // namespace mems_stiction
