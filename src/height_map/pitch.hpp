#pragma once

/// @file
/// Pixel pitches for which squares, areas and positions stay numbers.

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

inline constexpr double kSmallestPitch = 1e-15;  ///< [m]
inline constexpr double kLargestPitch = 1e3;     ///< [m]

inline bool isPitch(double pitch) { return pitch >= kSmallestPitch && pitch <= kLargestPitch; }

/// "must be in [1e-15, 1000] m, got 1e+150 x 1e-09"
inline std::string pitchComplaint(double pitch_x, double pitch_y) {
  return "the pitch must be > 0 m" +
         std::string(pitch_x > 0.0 && pitch_y > 0.0
                         ? ", " + Range::within(kSmallestPitch, kLargestPitch).text() + " m"
                         : "") +
         ", got " + numberText(pitch_x) + " x " + numberText(pitch_y);
}

}  // namespace mems_stiction
