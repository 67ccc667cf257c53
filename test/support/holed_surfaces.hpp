#pragma once

/// @file
/// Surfaces with missing pixels, for tests.

#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Pixels that are missing one by one, as where light comes back too weakly.
inline HeightMap withScatteredHoles(const HeightMap& surface, double share, int seed) {
  cv::Mat draws(surface.heights().size(), CV_64FC1);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(draws, cv::RNG::UNIFORM, 0.0, 1.0);
  cv::Mat heights = surface.asDouble().heights().clone();
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), draws < share);
  return {heights, surface.pitchX(), surface.pitchY()};
}

/// Discs of one to eight pixels of radius, until so much is missing.
inline HeightMap withRoundHoles(const HeightMap& surface, double share, int seed) {
  cv::Mat missing = cv::Mat::zeros(surface.heights().size(), CV_8UC1);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  while (cv::countNonZero(missing) < share * static_cast<double>(missing.total())) {
    const cv::Point centre(random.uniform(0, missing.cols), random.uniform(0, missing.rows));
    cv::circle(missing, centre, random.uniform(1, 9), cv::Scalar(255), cv::FILLED);
  }
  cv::Mat heights = surface.asDouble().heights().clone();
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), missing);
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
