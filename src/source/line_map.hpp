#pragma once

/// @file
/// From the lines of a scanner to a height map.
///
/// The lines lie side by side along the motion, at places that need not be even. Each is
/// interpolated to an even pitch along itself, then the map is interpolated between neighbouring
/// lines. Where neighbours are too far apart the map is not measured. A line at the place of
/// another one is left out. Lines that do not lie across the motion are put on a grid as clouds are
/// (cloud_grid.hpp).

#include <cstddef>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "source/cloud_grid.hpp"

namespace mems_stiction {

/// Points of one line in the frame of the map [m]; z = NaN is not measured.
using ScanLine = std::vector<cv::Vec3d>;

/// How lines become a map.
struct LineMapOptions {
  CloudOptions map;  ///< pitch_x and pitch_y of the map; 0 = that of the points and of line_pitch
  double line_pitch = 0.0;  ///< of the lines [m]; 0 = their median distance
};

/// A map, and which lines it lacks.
struct LineMap {
  CloudMap map;
  std::size_t lost = 0;     ///< places of the motion that have no line
  std::size_t doubled = 0;  ///< lines at the place of another one
};

/// @throw SurfaceError if fewer than two lines have a measured point, if far more lines are lost
/// than came, or as mapOfPoints()
LineMap mapOfLines(const std::vector<ScanLine>& lines, const LineMapOptions& options);

}  // namespace mems_stiction
