#pragma once

/// @file
/// What the seeded surfaces share: white noise, and its filtering in the space of wave vectors.

#include <functional>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Independent standard normal numbers, row by row: rows x cols CV_64FC1. The same seed gives the same numbers.
cv::Mat whiteNoise(int rows, int cols, int seed);

/// The noise with each of its waves multiplied by gain(q_x, q_y), wave numbers [rad/m]; the wave 0 is left out, so the
/// mean is 0. Periodic around the frame.
cv::Mat filteredNoise(const cv::Mat& noise, double pitch_x, double pitch_y,
                      const std::function<double(double, double)>& gain);

}  // namespace mems_stiction
