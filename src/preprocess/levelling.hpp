#pragma once

/// @file
/// Which shape is taken off a scan as its lie and bend.

#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "preprocess/working_surface.hpp"

namespace mems_stiction {

/// The plane without `robust` is that of level.hpp. The shape is not `none`.
/// @throw SurfaceError if no pixel is valid.
HeightChange levelBy(WorkingSurface& surface, const LevelOptions& options);

}  // namespace mems_stiction
