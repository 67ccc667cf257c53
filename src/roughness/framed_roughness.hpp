#pragma once

/// @file
/// spatial_roughness.hpp of a frame whose border is known to be none.

#include "mems_stiction/roughness/spatial_roughness.hpp"
#include "roughness/autocorrelation.hpp"

namespace mems_stiction {

/// - @p boundary `periodic`: the last column goes on in the first, and the last row in the first
/// row. Then autocorrelation and
///   summits wrap around, and the spectrum needs no window.
/// @throw SurfaceError if no pixel is valid.
SpatialRoughness spatialRoughness(const HeightMap& surface, const SpatialRoughnessOptions& options,
                                  FrameBoundary boundary);

}  // namespace mems_stiction
