#pragma once

/// @file
/// How does a scan lie, and what is left when its tilt is taken off?
///
///     z(x, y) ~ mean_height + slope_x (x - centre_x) + slope_y (y - centre_y),
///             least squares in z over the valid pixels
///
/// Coordinates are those of the grid: x = column * pitch_x, y = row * pitch_y. The fit runs about
/// the centroid of the valid pixels and their first height, in double, so a stage offset of
/// centimetres costs no digits of the roughness. Degenerate cases: where the valid pixels lie on
/// one line (one row, one column, two pixels), only the slope along that line is seen and the slope
/// across it is 0; a single pixel has no slope. Assumption: the tilt is small, heights are
/// subtracted along z and not along the plane's normal. At 1 degree that shortens heights by 0.015
/// %.
///
///     const HeightMap flat = levelled(scan);

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "preprocess/working_surface.hpp"

namespace mems_stiction {

/// z = offset + slope_x x + slope_y y.
struct Plane {
  double mean_height = 0.0;  ///< height at the centroid of the valid pixels [m]
  double slope_x = 0.0;      ///< dz/dx [-]
  double slope_y = 0.0;      ///< dz/dy [-]
  double centre_x = 0.0;     ///< centroid of the valid pixels [m]
  double centre_y = 0.0;     ///< [m]

  double height(double x, double y) const {
    return mean_height + (slope_x * (x - centre_x) + slope_y * (y - centre_y));
  }
};

/// @throw SurfaceError if no pixel is valid.
Plane leastSquaresPlane(WorkingSurface& surface);

/// The surface less its least-squares plane: rows x cols, CV_64FC1, metres, mean 0 over the valid
/// pixels. Invalid pixels are NaN.
/// @throw SurfaceError if no pixel is valid.
HeightMap levelled(const HeightMap& surface);
/// The same where the heights lie.
HeightChange level(WorkingSurface& surface);

/// Takes off the shape that the options name, which is not `none`: the plane without `robust` is
/// that of level().
/// @throw SurfaceError if no pixel is valid.
HeightChange levelBy(WorkingSurface& surface, const LevelOptions& options);

}  // namespace mems_stiction
