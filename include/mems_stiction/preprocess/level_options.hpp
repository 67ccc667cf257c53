#pragma once

/// @file
/// Which shape is taken off a scan as its lie and bend.

#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/working_surface.hpp"

namespace mems_stiction {

enum class LevelShape {
  kNone,
  kPlane,       ///< degree 1
  kPolynomial,  ///< degree 2
};

/// What is subtracted, and how it is fitted.
struct LevelOptions {
  LevelShape shape = LevelShape::kNone;
  bool robust = false;  ///< features and spikes have no say in the fit (polynomial_level.hpp)

  /// Keys are prefix and prefix + "_robust".
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/level");
};

/// rows x cols, CV_64FC1, metres; invalid pixels are NaN. The plane without `robust` is that of level.hpp.
/// @throw SurfaceError if no pixel is valid.
HeightMap levelledBy(const HeightMap& surface, const LevelOptions& options);
/// The same where the heights lie; the shape is not `none`.
HeightChange levelBy(WorkingSurface& surface, const LevelOptions& options);

}  // namespace mems_stiction
