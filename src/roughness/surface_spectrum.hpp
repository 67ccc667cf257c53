#pragma once

/// @file
/// The spectral density of a surface as a function: of the wave's length, and of its direction by
/// an elliptical stretch.
///
///     C(q) = C_iso(q'),   q'^2 = s q_along^2 + q_across^2/s
///
/// so correlation lengths along `direction` are s times as long as across it, and the variance is
/// that of C_iso, whatever s. C is the density of power_spectrum.hpp: <z^2> = integral of C d^2q/(2
/// pi)^2. Between two wave numbers of the table C_iso is the power law through both; below the
/// first one it is flat, beyond the last one zero.
///
///     SurfaceSpectrum spectrum;
///     // self-affine with H = 0.8 from 20 um to 20 nm
///     spectrum.wave_number = {2 * kPi / 20e-6, 2 * kPi / 20e-9};
///     spectrum.density = {1e-30, 1e-30 * std::pow(1000.0, -3.6)};

#include <string>
#include <vector>

namespace mems_stiction {

/// C by a table, stretched.
struct SurfaceSpectrum {
  std::vector<double> wave_number;  ///< of C_iso, ascending [rad/m]
  std::vector<double> density;      ///< C_iso there [m^4]
  double stretch = 1.0;  ///< s >= 1: correlation length along `direction` over that across it [-]
  double direction =
      0.0;  ///< of the longer correlation length, from x (along rows) towards y [rad]

  /// C at a wave vector [m^4]; 0 for the wave 0, which is no roughness.
  double densityAt(double q_x, double q_y) const;
  /// C_iso at |q'| > 0 [m^4].
  double densityAt(double q) const;
  /// <z^2> over all its waves [m^2].
  double variance() const;
  /// One line per value that is not allowed. `prefix` stands before its name.
  std::vector<std::string> validate(const std::string& prefix = "spectrum") const;
};

}  // namespace mems_stiction
