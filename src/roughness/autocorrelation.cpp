#include "mems_stiction/roughness/autocorrelation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/height_map/validity.hpp"

namespace mems_stiction {
namespace {

constexpr int kDirections = 360;  // half a turn: acf is symmetrical
constexpr double kStepsPerPixel = 4.0;

/// Sum of values(x) values(x + lag) over a frame of the given size, which pads with zeros; lag 0 at (0, 0), wrapped.
cv::Mat pairSums(const cv::Mat& values, const cv::Size& frame) {
  cv::Mat padded(frame, CV_64FC1, cv::Scalar(0.0));
  values.copyTo(padded(cv::Rect(0, 0, values.cols, values.rows)));
  cv::Mat spectrum;
  cv::dft(padded, spectrum, cv::DFT_COMPLEX_OUTPUT);
  cv::mulSpectrums(spectrum, spectrum, spectrum, 0, true);
  cv::Mat sums;
  cv::dft(spectrum, sums, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  return sums;
}

/// Bilinear. @param x, y in pixels from lag 0; within the map
double valueAt(const cv::Mat& acf, double x, double y) {
  const double col = x + 0.5 * (acf.cols - 1);
  const double row = y + 0.5 * (acf.rows - 1);
  const int left = std::min(std::max(static_cast<int>(col), 0), std::max(0, acf.cols - 2));
  const int top = std::min(std::max(static_cast<int>(row), 0), std::max(0, acf.rows - 2));
  const int right = std::min(left + 1, acf.cols - 1);
  const int bottom = std::min(top + 1, acf.rows - 1);
  const double u = col - left;
  const double v = row - top;
  return (1.0 - v) * ((1.0 - u) * acf.at<double>(top, left) + u * acf.at<double>(top, right)) +
         v * ((1.0 - u) * acf.at<double>(bottom, left) + u * acf.at<double>(bottom, right));
}

}  // namespace

cv::Mat autocorrelation(const HeightMap& surface, FrameBoundary boundary) {
  const HeightStatistics statistics = heightStatistics(surface);
  cv::Mat heights = ownedHeights(surface);
  heights -= statistics.mean;
  const cv::Mat valid = validMask(heights);
  heights.setTo(0.0, ~valid);
  const int half_rows = heights.rows / 2;
  const int half_cols = heights.cols / 2;
  cv::Mat acf(2 * half_rows + 1, 2 * half_cols + 1, CV_64FC1, cv::Scalar(0.0));
  const double range = statistics.max - statistics.min;
  if (range == 0.0) return acf;
  heights /= range;

  cv::Size frame = heights.size();
  if (boundary == FrameBoundary::kOpen) {
    frame.width = cv::getOptimalDFTSize(heights.cols + half_cols);
    frame.height = cv::getOptimalDFTSize(heights.rows + half_rows);
  }
  cv::Mat shares;
  valid.convertTo(shares, CV_64F, 1.0 / 255.0);
  const cv::Mat products = pairSums(heights, frame);
  const cv::Mat pairs = pairSums(shares, frame);
  const double variance = products.at<double>(0, 0) / std::round(pairs.at<double>(0, 0));
  for (int row = -half_rows; row <= half_rows; ++row) {
    for (int col = -half_cols; col <= half_cols; ++col) {
      const int from_row = (row + frame.height) % frame.height;
      const int from_col = (col + frame.width) % frame.width;
      const double count = std::round(pairs.at<double>(from_row, from_col));  // a whole number but for round-off
      acf.at<double>(row + half_rows, col + half_cols) =
          count > 0.0 ? products.at<double>(from_row, from_col) / count / variance
                      : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return acf;
}

SpatialParameters spatialParameters(const HeightMap& surface, FrameBoundary boundary, double s) {
  if (!Range::openWithin(0.0, 1.0).contains(s)) {
    throw OptionsError({"s: " + numberText(s) + " is not allowed, must be in (0, 1)"});
  }
  const cv::Mat acf = autocorrelation(surface, boundary);
  SpatialParameters found;
  if (acf.at<double>(acf.rows / 2, acf.cols / 2) == 0.0) return found;
  found.decayed = true;
  found.sal = std::numeric_limits<double>::infinity();
  const int half_cols = acf.cols / 2;
  const int half_rows = acf.rows / 2;
  for (int direction = 0; direction < kDirections; ++direction) {
    const double angle = kPi * direction / kDirections;
    // One pixel's length along this direction, and how many steps reach the border of the map.
    const double along_x = std::cos(angle) / surface.pitchX();
    const double along_y = std::sin(angle) / surface.pitchY();
    const double step = 1.0 / (kStepsPerPixel * std::hypot(along_x, along_y));
    const double limit =
        std::min(std::fabs(along_x) > 1e-9 / surface.pitchX() ? half_cols / std::fabs(along_x) : 1e300,
                 std::fabs(along_y) > 1e-9 / surface.pitchY() ? half_rows / std::fabs(along_y) : 1e300);
    double before = 1.0;
    double lag = limit;
    bool crossed = false;
    for (int index = 1; index * step <= limit; ++index) {
      const double value = valueAt(acf, index * step * along_x, index * step * along_y);
      if (value <= s) {
        lag = step * (index - (s - value) / (before - value));
        crossed = true;
        break;
      }
      before = value;
    }
    found.decayed = found.decayed && crossed;
    found.longest = std::max(found.longest, lag);
    if (lag < found.sal) {
      found.sal = lag;
      found.sal_direction = angle;
    }
  }
  found.str = found.longest > 0.0 ? found.sal / found.longest : 0.0;
  return found;
}

}  // namespace mems_stiction
