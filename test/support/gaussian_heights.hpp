#pragma once

/// @file
/// Heights of a Gaussian surface in the double precision in which they are made, for tests.

#include <cmath>

#include <opencv2/core.hpp>

#include "roughness/half_spectrum.hpp"
#include "surface/random_field.hpp"

namespace mems_stiction {

/// Periodic, side x side pixels, of exactly this rms height, autocorrelation exp(-r^2/length^2).
inline cv::Mat gaussianHeights(int side, double pitch, double length, double rms, int seed) {
  const cv::Mat field = filteredNoise(whiteNoise(side, side, seed), [&](int row, int col) {
    const double q = std::hypot(waveNumber(col, side, pitch), waveNumber(row, side, pitch));
    return std::exp(-q * q * length * length / 8.0);
  });
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(field, mean, deviation);
  return field * (rms / deviation[0]);
}

}  // namespace mems_stiction
