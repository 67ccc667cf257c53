#include "preprocess/tilt.hpp"

#include <cmath>
#include <limits>

#include "errors/short_number.hpp"
#include "preprocess/level.hpp"
#include "preprocess/polynomial_level.hpp"

namespace mems_stiction {
namespace {

constexpr double kLarge = 0.5;
constexpr int kMostOfASide = 64;
constexpr int kFewestPixels = 3;

int strideFor(int size) { return (size + kMostOfASide - 1) / kMostOfASide; }

/// Every so manyth pixel of every so manyth row, from the middle of the first block.
HeightMap sampleOf(const HeightMap& scan) {
  const int row_stride = strideFor(scan.rows());
  const int col_stride = strideFor(scan.cols());
  cv::Mat sample(scan.rows() / row_stride, scan.cols() / col_stride, CV_64FC1);
  for (int row = 0; row < sample.rows; ++row) {
    for (int col = 0; col < sample.cols; ++col) {
      const double height =
          scan.height(row * row_stride + row_stride / 2, col * col_stride + col_stride / 2);
      sample.at<double>(row, col) =
          std::isfinite(height) ? height : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return {sample, col_stride * scan.pitchX(), row_stride * scan.pitchY()};
}

}  // namespace

bool Tilt::isLarge() const { return levelled_rms_height < kLarge * rms_height; }

std::string Tilt::advice() const {
  return "the scan is tilted: a plane takes its rms height from " + shortNumber(rms_height) +
         " m to " + shortNumber(levelled_rms_height) +
         " m and what touches is its highest edge; unless the tilt is that of the device set "
         "preprocessing/level to "
         "plane first and see what is still asked for (predict_scan --cleanings tells what this "
         "and other steps "
         "change)";
}

Tilt tiltOf(const HeightMap& scan) {
  const HeightMap sample = sampleOf(scan);
  const cv::Mat valid = sample.heights() == sample.heights();
  if (cv::countNonZero(valid) < kFewestPixels) return {};
  return {heightStatistics(sample).rms_height, heightStatistics(levelled(sample)).rms_height};
}

std::string TiltLeft::advice() const {
  return "tall features have pulled the levelling aslant: their ground is left with a tilt of " +
         shortNumber(rms_height) + " m rms and is itself rough by " + shortNumber(noise) +
         " m; set preprocessing/level_robust to true";
}

TiltLeft tiltLeft(const HeightMap& levelled, int degree) {
  const HeightMap sample = sampleOf(levelled);
  const cv::Mat valid = sample.heights() == sample.heights();
  if (cv::countNonZero(valid) < kFewestPixels) return {};
  const double surface_rms_height = heightStatistics(sample).rms_height;
  WorkingSurface work(sample);
  const PolynomialSurface fit = fitPolynomial(work.heights, work.pitch_x, work.pitch_y, degree,
                                              FitWeights::kRobust, work.memory);
  work.heights.setTo(0.0, valid);
  subtract(fit, work);
  return {heightStatistics(work.surface()).rms_height, fit.noise, surface_rms_height};
}

}  // namespace mems_stiction
