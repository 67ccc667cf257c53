#include "roughness/autocorrelation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/constants.hpp"
#include "numeric/value_range.hpp"
#include "preprocess/working_surface.hpp"
#include "roughness/half_spectrum.hpp"

namespace mems_stiction {
namespace {

constexpr int kDirections = 360;  // half a turn: acf is symmetrical
constexpr double kStepsPerPixel = 4.0;

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

/// @return lags up to half_rows, half_cols, at most half of the frame
cv::Mat autocorrelationUpTo(int half_rows, int half_cols, const HeightMap& surface,
                            FrameBoundary boundary) {
  WorkingSurface work(surface);
  cv::Mat& heights = work.heights;
  const double mean = meansOf(heights, work.memory).height;
  ValueRange range;
  for (int row = 0; row < heights.rows; ++row) {
    addToRange(heights.ptr<double>(row), static_cast<std::size_t>(heights.cols), range);
  }
  if (range.highest == range.lowest) {
    return cv::Mat(2 * half_rows + 1, 2 * half_cols + 1, CV_64FC1, cv::Scalar(0.0));
  }
  const cv::Size frame = boundary == FrameBoundary::kPeriodic
                             ? heights.size()
                             : cv::Size(cv::getOptimalDFTSize(heights.cols + half_cols),
                                        cv::getOptimalDFTSize(heights.rows + half_rows));
  const bool is_whole = range.count == static_cast<long long>(heights.total());
  cv::Mat pairs;
  if (!is_whole) {
    const cv::Mat valid = validMask(heights);
    cv::Mat shares;
    valid.convertTo(shares, CV_64F, 1.0 / 255.0);
    pairs = pairSums(shares, frame, half_rows, half_cols);
    heights.setTo(mean, ~valid);
  }
  heights -= mean;
  heights /= range.highest - range.lowest;
  cv::Mat acf = pairSums(heights, frame, half_rows, half_cols);
  const auto countAt = [&](int row, int col) {
    if (!is_whole)
      return std::round(pairs.at<double>(row, col));  // a whole number but for round-off
    if (boundary == FrameBoundary::kPeriodic) return static_cast<double>(heights.total());
    return static_cast<double>(heights.rows - std::abs(row - half_rows)) *
           (heights.cols - std::abs(col - half_cols));
  };
  const double variance = acf.at<double>(half_rows, half_cols) / countAt(half_rows, half_cols);
  for (int row = 0; row < acf.rows; ++row) {
    double* line = acf.ptr<double>(row);
    for (int col = 0; col < acf.cols; ++col) {
      const double count = countAt(row, col);
      line[col] =
          count > 0.0 ? line[col] / count / variance : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return acf;
}

/// @param acf lags up to some of the surface's size
SpatialParameters parametersOf(const cv::Mat& acf, const HeightMap& surface, double s) {
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
    const double limit = std::min(
        std::fabs(along_x) > 1e-9 / surface.pitchX() ? half_cols / std::fabs(along_x) : 1e300,
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
    found.sal = std::min(found.sal, lag);
  }
  found.str = found.longest > 0.0 ? found.sal / found.longest : 0.0;
  return found;
}

}  // namespace

cv::Mat autocorrelation(const HeightMap& surface, FrameBoundary boundary) {
  return autocorrelationUpTo(surface.rows() / 2, surface.cols() / 2, surface, boundary);
}

SpatialParameters spatialParameters(const HeightMap& surface, FrameBoundary boundary, double s) {
  if (!Range::openWithin(0.0, 1.0).contains(s)) {
    throw OptionsError({"s: " + numberText(s) + " is not allowed, must be in (0, 1)"});
  }
  if (boundary == FrameBoundary::kOpen) {
    // Most surfaces forget themselves within short lags, which a smaller transform gives.
    const cv::Mat near =
        autocorrelationUpTo(surface.rows() / 8, surface.cols() / 8, surface, boundary);
    const SpatialParameters found = parametersOf(near, surface, s);
    if (found.decayed) return found;
  }
  return parametersOf(autocorrelation(surface, boundary), surface, s);
}

}  // namespace mems_stiction
