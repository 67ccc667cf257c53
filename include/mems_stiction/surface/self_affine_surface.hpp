#pragma once

/// @file
/// A random surface that looks alike on many scales.
///
///     C(q) = C0                        for q < q_r = 2 pi/rolloff_wavelength
///     C(q) = C0 (q/q_r)^(-2 - 2 H)     for q_r <= q <= q_s = 2 pi/cutoff_wavelength
///     C(q) = 0                         beyond
///
/// with C the power spectral density of power_spectrum.hpp and H the Hurst exponent. White noise is filtered by
/// sqrt(C), so the surface is periodic: its last column goes on in its first, its last row in its first row. Then it is
/// scaled so that either the rms height or the rms slope sqrt(<|grad z|^2>), summed over its waves, is exact. Heights
/// are Gaussian. Outside: a cut-off below two pitches, or a roll-off beyond the frame, cannot be drawn and is refused.
/// Source: Persson, Albohr, Tartaglino, Volokitin, Tosatti, J. Phys.: Condens. Matter 17 (2005) R1, section 2.
///
///     SelfAffineSurfaceOptions options;
///     options.hurst_exponent = 0.8;
///     const HeightMap surface = selfAffineSurface(options);

#include <string>
#include <vector>

#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

enum class RoughnessScale {
  kRmsHeight,  ///< rms_height is exact
  kRmsSlope,   ///< rms_slope is exact
};

/// Defaults: a 5.1 um frame of a smooth polysilicon film.
struct SelfAffineSurfaceOptions {
  int rows = 512;                    ///< in [2, 32768]
  int cols = 512;                    ///< in [2, 32768]
  double pitch_x = 10e-9;            ///< [m], > 0
  double pitch_y = 10e-9;            ///< [m], > 0
  double hurst_exponent = 0.8;       ///< H, in [0, 1]
  double rolloff_wavelength = 1e-6;  ///< [m], > cutoff_wavelength, at most the frame's longer side
  double cutoff_wavelength = 40e-9;  ///< [m], at least two of the larger pitch
  RoughnessScale scale = RoughnessScale::kRmsHeight;
  double rms_height = 3e-9;  ///< [m], >= 0
  double rms_slope = 0.1;    ///< [-], >= 0
  int seed = 1;              ///< >= 0; the same seed gives the same surface

  /// Keys are prefix + "/rows" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix);
  /// One line per violated constraint; empty when all is well.
  std::vector<std::string> validate(const std::string& prefix = "self_affine") const;
};

/// @return rows x cols, CV_64FC1, metres, zero mean, all valid.
/// @throw OptionsError with the lines of validate(), if there are any.
HeightMap selfAffineSurface(const SelfAffineSurfaceOptions& options);

}  // namespace mems_stiction
