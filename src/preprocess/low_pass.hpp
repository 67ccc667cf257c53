#pragma once

/// @file
/// The Gaussian areal filter of ISO 16610-61: what is left of a surface above a cut-off wavelength.
///
///     s(x, y) = exp(-pi (x^2 + y^2)/(alpha lc)^2)/(alpha lc)^2,  alpha = sqrt(ln 2/pi)
///
/// A sine of the cut-off wavelength lc keeps half of its amplitude, one of wavelength l keeps
/// 2^-(lc/l)^2. Near the border and around invalid pixels the weights of what is missing are left
/// out and the others normalized (zeroth-order regression). So a tilt is bent within about lc/2 of
/// the border: level first. Invalid pixels stay invalid. Weights are cut off at a distance of lc,
/// where they are 1e-6 of the largest. Outside: a cut-off below the pitch changes nothing.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline_options.hpp"

namespace mems_stiction {

/// rows x cols, CV_64FC1, metres; invalid pixels are NaN.
/// @throw SurfaceError if no pixel is valid.
HeightMap lowPassed(const HeightMap& surface, const LowPassOptions& options);

}  // namespace mems_stiction
