#pragma once

/// @file
/// A random surface that looks alike on many scales.
///
///     C(q) = C0                        for q < q_r = 2 pi/rolloff_wavelength
///     C(q) = C0 (q/q_r)^(-2 - 2 H)     for q_r <= q <= q_s = 2 pi/cutoff_wavelength
///     C(q) = 0                         beyond
///
/// with C the power spectral density of power_spectrum.hpp and H the Hurst exponent. White noise is
/// filtered by sqrt(C), so the surface is periodic: its last column goes on in its first, its last
/// row in its first row. Then it is scaled so that either the rms height or the rms slope
/// sqrt(<|grad z|^2>), summed over its waves, is exact. Heights are Gaussian. Outside: a cut-off
/// below two pitches, or a roll-off beyond the frame, cannot be drawn and is refused. Source:
/// Persson, Albohr, Tartaglino, Volokitin, Tosatti, J. Phys.: Condens. Matter 17 (2005) R1,
/// section 2.
///
///     SelfAffineSurfaceOptions options;
///     options.hurst_exponent = 0.8;
///     const HeightMap surface = selfAffineSurface(options);

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/surface/counter_surface_options.hpp"

namespace mems_stiction {

/// @return rows x cols, CV_64FC1, metres, zero mean, all valid.
/// @throw OptionsError with the lines of validate(), if there are any.
HeightMap selfAffineSurface(const SelfAffineSurfaceOptions& options);

}  // namespace mems_stiction
