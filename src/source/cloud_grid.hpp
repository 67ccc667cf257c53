#pragma once

/// @file
/// From points to a height map. Points that lie on a grid already keep their own heights; others
/// are put on one.
///
/// The map has its largest y in row 0, and x grows along the columns. A grid of points may have
/// rows and columns the other way round and run in either direction. It is even if no point lies
/// further from its place than the tolerance. Other points are averaged over the cells of a grid,
/// after their mean plane has been taken off, so that a tilted surface has no steps. Cells without
/// a point are not measured.

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Whether lateral axes are turned round, since the sensor's are left-handed.
enum class Mirror { kAuto, kX, kY, kNone };

/// How points become a map.
struct CloudOptions {
  double pitch_x = 0.0;           ///< of the map [m]; 0 = that of the points
  double pitch_y = 0.0;           ///< [m]
  bool is_up_negative = false;    ///< heights grow along -z
  Mirror mirror = Mirror::kAuto;  ///< auto = y with heights along -z, as a sensor that is turned
                                  ///< over has it, else none
  double invalid_below = -10.0;   ///< points with a lower z are not measured [m]
  double invalid_above = 10.0;    ///< points with a higher z are not measured [m]
  double grid_tolerance = 0.1;    ///< of an even grid, over its pitch [-]
};

/// A map, and what its user should know.
struct CloudMap {
  HeightMap surface;
  std::vector<std::string> notes;
};

/// z becomes NaN where it is not finite, or beyond the limits, or x or y are not finite.
void dropUnmeasured(cv::Mat& points, const CloudOptions& options);

/// Factors 1 or -1 of x, y and z, by `up` and `mirror`.
cv::Vec3d axisSigns(const CloudOptions& options);

/// - @p points rows x cols of CV_64FC3: x, y, z [m]; z = NaN is not measured. One row or column: no
/// order is known.
/// @throw SurfaceError if there is no measured point, no pitch, or no area.
CloudMap mapOfPoints(const cv::Mat& points, const CloudOptions& options);

}  // namespace mems_stiction
