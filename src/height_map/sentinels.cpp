#include "mems_stiction/height_map/sentinels.hpp"

#include <limits>

#include "mems_stiction/height_map/validity.hpp"

namespace mems_stiction {

cv::Mat sentinelMask(const cv::Mat& heights) {
  cv::Mat beyond = cv::abs(heights) > kLargestHeight;
  beyond &= validMask(heights);
  return beyond;
}

HeightMap withoutSentinels(const HeightMap& surface) {
  // Without a mask of its own for the many scans that have no such pixel.
  if (cv::checkRange(surface.heights(), true, nullptr, -kLargestHeight, kLargestHeight)) return surface;
  const cv::Mat beyond = sentinelMask(surface.heights());
  if (cv::countNonZero(beyond) == 0) return surface;
  cv::Mat heights = ownedHeights(surface);
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), beyond);
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
