#pragma once

/// @file
/// Which pixels jump out of their surroundings?
///
/// The residual of a pixel is its height less the median of the window around it, on the surface
/// less its robust polynomial of degree 2 (so that tilt and bow do not count at the border). Pixels
/// whose residual is further from the median residual than threshold x 1.4826 x (median absolute
/// deviation of all residuals) become invalid; fill_holes.hpp gives them a height again. Where more
/// than half of the residuals are equal (coarsely counted heights), the median runs over those that
/// differ. Assumptions: a spike covers less than half a window. On Gaussian roughness a threshold
/// of 6 removes two pixels in 10^9; surfaces that carry real particles of a few pixels lose them:
/// choose a smaller window or a higher threshold. The polynomial is found to 1e-4 of its noise
/// (fitPolynomialBySamples), which moves a residual by some 1e-6 of the noise. That can decide
/// about a pixel only where heights are counted in steps as coarse as the roughness: distances then
/// come in clusters, and one can meet the limit.

#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "preprocess/working_surface.hpp"

namespace mems_stiction {

/// Spikes become NaN.
/// @throw SurfaceError if no pixel is valid.
HeightChange removeSpikes(WorkingSurface& surface, const SpikeOptions& options);

}  // namespace mems_stiction
