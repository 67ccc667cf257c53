#pragma once

/// @file
/// Which shape is taken off a scan as its lie and bend.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "mems_stiction/preprocess/working_surface.hpp"

namespace mems_stiction {

/// rows x cols, CV_64FC1, metres; invalid pixels are NaN. The plane without `robust` is that of level.hpp.
/// @throw SurfaceError if no pixel is valid.
HeightMap levelledBy(const HeightMap& surface, const LevelOptions& options);
/// The same where the heights lie; the shape is not `none`.
HeightChange levelBy(WorkingSurface& surface, const LevelOptions& options);

}  // namespace mems_stiction
