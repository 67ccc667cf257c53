#pragma once

/// @file
/// Points of a message as numbers: fields by name, of either precision, in either order of bytes,
/// wherever they lie.

#include <string>

#include <geometry_msgs/Transform.h>
#include <sensor_msgs/PointCloud2.h>
#include <opencv2/core.hpp>

namespace mems_stiction {

/// height x width of CV_64FC3: x, y, z [m] as the message states them.
/// @throw SurfaceError naming a field that is missing or of another type, or sizes that do not
/// agree with each other.
cv::Mat cloudPoints(const sensor_msgs::PointCloud2& cloud);

/// The points in another frame.
/// - @p points CV_64FC3
void transformPoints(const geometry_msgs::Transform& transform, cv::Mat& points);

}  // namespace mems_stiction
