#pragma once

/// A matrix as a NumPy array file, for what reads results in Python.

#include <string>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Format version 1.0: the shape, then the pixels row by row.
/// @param pixels CV_8UC1, CV_32FC1 or CV_64FC1
/// @throw FileError
void writeNpy(const std::string& path, const cv::Mat& pixels);

}  // namespace mems_stiction
