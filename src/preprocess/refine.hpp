#pragma once

/// @file
/// More pixels from the same scan, so that an asperity of one or two pixels is no longer a spike.
///
/// Each pixel becomes factor x factor pixels; pitches are divided by the factor, so the frame keeps
/// its size and its nominal area. Interpolation along x and y in turn, in double:
/// - cubic: Keys' cubic convolution with a = -1/2 (IEEE Trans. ASSP 29 (1981) 1153). Four pixels
/// per axis; polynomials
///   of degree 2 come back exactly, so curvatures of resolved asperities are kept.
/// - lanczos: windowed sinc over six pixels per axis, weights normalized. Sharper; rings by a few
/// per cent at steps. At the frame's border the surface goes on by its reflection through the
/// border pixel, which keeps planes. A refined pixel is invalid when the pixel it lies in is.
/// Weights that reach over an invalid pixel meet the thin plate of fill_holes.hpp there.
/// Interpolation adds no information: wavelengths below two original pitches stay unknown.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline_options.hpp"

namespace mems_stiction {

/// factor rows x factor cols, CV_64FC1, metres.
/// @throw SurfaceError if no pixel is valid, or the result would have more than 2^29 pixels.
HeightMap refined(const HeightMap& surface, const RefineOptions& options);

}  // namespace mems_stiction
