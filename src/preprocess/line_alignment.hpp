#pragma once

/// @file
/// Taking off what changes from one scan line to the next: jumps, drift, bow of the fast axis.
/// Lines are rows.
///
/// - median: each line less its median.
/// - median_difference: each line is shifted so that the median of its differences from the line
/// before it is 0. The
///   usual cure for jumps; features that fill less than half of both lines have no say.
/// - polynomial: each line less its own robust polynomial (polynomial_level.hpp) of degree 0 to 2.
///
/// What it costs: a line cannot tell its own offset from the surface's. All three take the tilt
/// along y and every wavelength along y that is longer than the frame out of the surface; a sphere
/// that fills the frame loses its shape. Lines without a valid pixel stay as they are. The mean
/// height of the surface is kept.

#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "preprocess/working_surface.hpp"

namespace mems_stiction {

/// @throw SurfaceError if no pixel is valid.
HeightChange alignLines(WorkingSurface& surface, const LineAlignmentOptions& options);

}  // namespace mems_stiction
