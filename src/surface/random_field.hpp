#pragma once

/// @file
/// What the seeded surfaces share: white noise, and its filtering in the space of wave vectors.

#include <functional>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Independent standard normal numbers, row by row: rows x cols CV_64FC1. The same seed gives the
/// same numbers.
cv::Mat whiteNoise(int rows, int cols, int seed);

/// The noise with each of its waves multiplied by gain(row, col), its place in the transform; the
/// wave 0 is left out, so the mean is 0. Periodic around the frame.
cv::Mat filteredNoise(const cv::Mat& noise, const std::function<double(int, int)>& gain);

}  // namespace mems_stiction
