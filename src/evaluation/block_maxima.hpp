#pragma once

/// @file
/// A map of finer cells, said of the pixels of the scan.

#include <opencv2/core.hpp>

namespace mems_stiction {

/// The largest value in each block of factor x factor cells; CV_8UC1, both sides multiples of the
/// factor.
cv::Mat blockMaxima(const cv::Mat& cells, int factor);

}  // namespace mems_stiction
