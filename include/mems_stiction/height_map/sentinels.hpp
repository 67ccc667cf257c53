#pragma once

/// @file
/// Numbers that stand for "no height": programs and drivers write 1e38, FLT_MAX, DBL_MAX and the like.

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Largest number that is a height [m].
constexpr double kLargestHeight = 1e20;

/// rows x cols CV_8UC1: 255 where a finite number lies beyond kLargestHeight, 0 elsewhere.
cv::Mat sentinelMask(const cv::Mat& heights);

/// The surface with those pixels invalid; the same, its pixels shared, if there are none.
HeightMap withoutSentinels(const HeightMap& surface);

}  // namespace mems_stiction
