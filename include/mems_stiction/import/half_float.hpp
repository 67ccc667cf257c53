#pragma once

/// @file
/// Numbers of 16 bits by IEEE 754.

#include <cmath>
#include <cstdint>
#include <limits>

namespace mems_stiction {

inline double halfToFloat(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const int fraction = bits & 1023;
  double value = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(fraction + 1024, exponent - 25);
  if (exponent == 31) {
    value = fraction == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  }
  return bits >> 15 != 0 ? -value : value;
}

}  // namespace mems_stiction
