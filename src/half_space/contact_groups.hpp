#pragma once

/// @file
/// How many contacts are there?

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Groups of pixels that are not zero and share a side.
/// - @p mask rows x cols CV_8UC1
/// - @p wraps whether the first row and column continue the last ones
int countContactGroups(const cv::Mat& mask, bool wraps);

}  // namespace mems_stiction
