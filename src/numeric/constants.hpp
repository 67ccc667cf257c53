#pragma once

/// @file
/// Physical constants, SI.

namespace mems_stiction {

inline constexpr double kPi = 3.14159265358979323846;

/// Permittivity of vacuum [F/m], CODATA 2018.
inline constexpr double kVacuumPermittivity = 8.8541878128e-12;

}  // namespace mems_stiction
