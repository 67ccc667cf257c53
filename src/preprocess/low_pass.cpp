#include "preprocess/low_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "height_map/validity.hpp"

namespace mems_stiction {
namespace {

/// One row of weights, no longer than the frame can use.
cv::Mat weightsOf(double pitch, double cutoff_wavelength, int count) {
  const double alpha_squared = std::log(2.0) / CV_PI;
  const double pixels = cutoff_wavelength / pitch;
  const int reach = std::min(static_cast<int>(std::ceil(std::min(pixels, 1e9))), count - 1);
  cv::Mat weights(1, 2 * reach + 1, CV_64FC1);
  for (int index = -reach; index <= reach; ++index) {
    const double distance = index / pixels;
    weights.at<double>(0, index + reach) = std::exp(-CV_PI * distance * distance / alpha_squared);
  }
  return weights;
}

}  // namespace

void LowPassOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.number(prefix + "/cutoff_wavelength", cutoff_wavelength, "m", Range::nonNegative(),
                 "wavelength that a Gaussian filter (ISO 16610-61) halves, shorter ones it takes "
                 "away; 0 = off");
}

HeightMap lowPassed(const HeightMap& surface, const LowPassOptions& options) {
  const double mean = heightStatistics(surface).mean;
  cv::Mat heights = ownedHeights(surface);
  if (options.cutoff_wavelength == 0.0) return {heights, surface.pitchX(), surface.pitchY()};
  const cv::Mat valid = validMask(heights);
  heights -= mean;
  heights.setTo(0.0, ~valid);
  cv::Mat shares;
  valid.convertTo(shares, CV_64F, 1.0 / 255.0);

  const cv::Mat weights_x = weightsOf(surface.pitchX(), options.cutoff_wavelength, surface.cols());
  const cv::Mat weights_y = weightsOf(surface.pitchY(), options.cutoff_wavelength, surface.rows());
  const cv::Point middle(-1, -1);
  cv::Mat sums;
  cv::sepFilter2D(heights, sums, CV_64F, weights_x, weights_y, middle, 0.0,
                  cv::BORDER_CONSTANT | cv::BORDER_ISOLATED);
  cv::sepFilter2D(shares, shares, CV_64F, weights_x, weights_y, middle, 0.0,
                  cv::BORDER_CONSTANT | cv::BORDER_ISOLATED);
  cv::divide(sums, shares, sums);
  sums += mean;
  sums.setTo(std::numeric_limits<double>::quiet_NaN(), ~valid);
  return {sums, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
