#pragma once

/// @file
/// How far a surface's roughness reaches sideways, in one table: autocorrelation, spectrum,
/// summits, self-affinity.
///
/// Heights and their meaning: autocorrelation.hpp, power_spectrum.hpp (Hann window: a measured
/// frame does not wrap around), summits.hpp. Levelling is the caller's. Takes up to twice as long
/// as a prediction, hence off by default. Outside: with a side below 8 pixels the spectral figures
/// and Hurst's exponent are NaN, and the exponent too where fewer than three rings of the spectrum
/// lie in its range.
///
///     const SpatialRoughness figures = spatialRoughness(scan, SpatialRoughnessOptions());
///     print(figures.sal, figures.hurst);

#include <limits>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Whether it is computed, and where the exponent is fitted.
struct SpatialRoughnessOptions {
  bool enabled = false;
  /// Wavelengths between which the power law is fitted [m], >= 0. 0 = 8 pitches: shorter ones carry
  /// the tip and noise.
  double hurst_shortest_wavelength = 0.0;
  /// 0 = a quarter of the shorter side: longer ones have too few waves, and what levelling left.
  double hurst_longest_wavelength = 0.0;

  void describe(OptionVisitor& visitor);
};

/// NaN = not computed.
struct SpatialRoughness {
  double sal = std::numeric_limits<double>::quiet_NaN();  ///< autocorrelation length, to 0.2 [m]
  double str = std::numeric_limits<double>::quiet_NaN();  ///< texture aspect ratio [-]
  double m0 = std::numeric_limits<double>::quiet_NaN();   ///< [m^2]
  double m2 = std::numeric_limits<double>::quiet_NaN();   ///< mean squared slope of a profile [-]
  double m4 =
      std::numeric_limits<double>::quiet_NaN();  ///< mean squared curvature of a profile [1/m^2]
  double nayak = std::numeric_limits<double>::quiet_NaN();               ///< m0 m4/m2^2 [-]
  double summit_density = std::numeric_limits<double>::quiet_NaN();      ///< [1/m^2]
  double mean_summit_radius = std::numeric_limits<double>::quiet_NaN();  ///< 1/mean curvature [m]
  double hurst = std::numeric_limits<double>::quiet_NaN();               ///< [-]
};

/// @throw SurfaceError if no pixel is valid.
SpatialRoughness spatialRoughness(const HeightMap& surface, const SpatialRoughnessOptions& options);

}  // namespace mems_stiction
