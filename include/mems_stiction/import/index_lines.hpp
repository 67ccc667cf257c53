#pragma once

/// @file
/// Rows and columns of a grid that number the others, or are coordinates: no heights.

#include <string>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Which row or column at the border of the grid counts, or goes in equal steps, though the others do not; in words
/// that end with what to do. Empty if there is none. - @p grid CV_64FC1
std::string indexLine(const cv::Mat& grid);

}  // namespace mems_stiction
