#pragma once

/// @file
/// Heights as text: one row of the scan per line, row 0 first.

#include <string>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Numbers are separated by commas, semicolons, tabs or spaces, with a decimal point; "nan", "inf" and an empty cell
/// between two commas are invalid pixels; '#' begins a comment; empty lines do not count.
/// @return rows x cols CV_64FC1 in the unit of the file.
/// @throw FileError naming the file, and the line where there is one, for text that is not such a grid.
cv::Mat readTextGrid(const std::string& path);

}  // namespace mems_stiction
