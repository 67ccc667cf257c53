#pragma once

/// @file
/// Constants of mathematics and of physics, SI.

namespace mems_stiction {

inline constexpr double kPi = 3.14159265358979323846;

/// Standard deviations to either side of the mean that contain 95 % of a normal distribution [-].
inline constexpr double kNormal95 = 1.95996398454005424;

/// Permittivity of vacuum [F/m], CODATA 2018.
inline constexpr double kVacuumPermittivity = 8.8541878128e-12;

}  // namespace mems_stiction
