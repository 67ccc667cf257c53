#pragma once

/// @file
/// Which pixels of a height map were measured.

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// rows x cols CV_8UC1: 255 where the height is finite, 0 elsewhere.
cv::Mat validMask(const cv::Mat& heights);

/// Share of pixels that are invalid [-].
double invalidFraction(const HeightMap& surface);

/// The heights as rows x cols CV_64FC1 that nobody else shows, every invalid pixel NaN (never an
/// infinity).
cv::Mat ownedHeights(const HeightMap& surface);

}  // namespace mems_stiction
