#include "height_map/validity.hpp"

#include <limits>

namespace mems_stiction {

cv::Mat validMask(const cv::Mat& heights) {
  const double largest = heights.depth() == CV_32F ? std::numeric_limits<float>::max()
                                                   : std::numeric_limits<double>::max();
  return cv::Mat(cv::abs(heights) <= largest);  // false for NaN and infinities
}

double invalidFraction(const HeightMap& surface) {
  if (surface.empty()) return 0.0;
  const double valid = cv::countNonZero(validMask(surface.heights()));
  return 1.0 - valid / static_cast<double>(surface.heights().total());
}

cv::Mat ownedHeights(const HeightMap& surface) {
  cv::Mat heights;
  surface.heights().convertTo(heights, CV_64F);
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), ~validMask(heights));
  return heights;
}

}  // namespace mems_stiction
