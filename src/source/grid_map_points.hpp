#pragma once

/// @file
/// From a layer of a GridMap to points.
///
/// A GridMap is a circular buffer, as grid_map_core defines it: row 0 behind the start index has
/// the largest x, and x falls along the rows; column 0 behind its start index has the largest y,
/// and y falls along the columns. Labels say whether rows or columns lie side by side in memory.

#include <string>

#include <opencv2/core.hpp>

#include "source/grid_map_message.hpp"

namespace mems_stiction {

/// rows x cols of the map, CV_64FC3: x, y, height [m]. A height is NaN where the layer or one of
/// the basic layers is not finite.
/// - @p layer that the heights are in
/// - @p is_posed points are in the frame of the header by the pose of the map; else in the map's
/// own axes, about its middle
/// @throw SurfaceError naming a layer that is missing, or figures that do not agree with each other
cv::Mat gridMapPoints(const GridMapMessage& map, const std::string& layer, bool is_posed);

}  // namespace mems_stiction
