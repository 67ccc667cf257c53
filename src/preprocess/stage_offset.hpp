#pragma once

/// @file
/// Taking the height of the stage off a scan, before anything narrows it to single precision.
///
/// Single precision spaces heights of 10 mm by 0.9 nm: under such an offset the roughness drowns.
/// The difference is taken in double. Digits that the scan had already lost when it arrived do not
/// come back.

#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "preprocess/working_surface.hpp"

namespace mems_stiction {

/// The surface less its mean height.
/// @throw SurfaceError if no pixel is valid.
HeightChange subtractStageOffset(WorkingSurface& surface);

}  // namespace mems_stiction
