#pragma once

/// @file
/// Taking the height of the stage off a scan, before anything narrows it to single precision.
///
/// Single precision spaces heights of 10 mm by 0.9 nm: under such an offset the roughness drowns. The difference is
/// taken in double. Digits that the scan had already lost when it arrived do not come back.

#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/working_surface.hpp"

namespace mems_stiction {

/// Whether the mean height is subtracted.
struct StageOffsetOptions {
  bool enabled = false;

  /// Keys are prefix + "/enabled".
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/offset");
};

/// The surface less its mean height: rows x cols, CV_64FC1, metres; invalid pixels are NaN.
/// @throw SurfaceError if no pixel is valid.
HeightMap withoutStageOffset(const HeightMap& surface);
/// The same where the heights lie.
HeightChange subtractStageOffset(WorkingSurface& surface);

}  // namespace mems_stiction
