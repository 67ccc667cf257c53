#include "surface/wear.hpp"

#include <utility>

#include "height_map/validity.hpp"

namespace mems_stiction {
namespace {

/// A level plane has the heights 0.
cv::Mat heightsOf(const HeightMap& surface, const cv::Size& size) {
  return surface.empty() ? cv::Mat(cv::Mat::zeros(size, CV_64FC1)) : surface.asDouble().heights();
}

}  // namespace

HeightMap Wear::Side::on(const HeightMap& as_made, const HeightMap& grid) const {
  const cv::Size size = grid.heights().size();
  if (!is_changed || left.size() != size || (!as_made.empty() && as_made.heights().size() != size))
    return as_made;
  const cv::Mat heights = heightsOf(as_made, size);
  cv::Mat worn =
      left +
      (heights - made);  // in this order: the same surface again is what was left, to the bit
  heights.copyTo(worn, ~validMask(worn));  // pixels that one of them lacks
  return {worn, grid.pitchX(), grid.pitchY()};
}

void Wear::Side::add(const cv::Mat& as_made, const cv::Mat& after) {
  const cv::Mat is_known = validMask(after);
  cv::Mat new_made = as_made;
  cv::Mat new_left = after;
  if (left.size() == after.size()) {
    new_made = made.clone();
    new_left = left.clone();
    as_made.copyTo(new_made, is_known);
    after.copyTo(new_left, is_known);
  }
  made = std::move(new_made);
  left = std::move(new_left);
  is_changed = cv::countNonZero((left != made) & validMask(left)) > 0;
}

SurfacePair Wear::on(const SurfacePair& as_made) const {
  return {lower_.on(as_made.lower, as_made.lower), upper_.on(as_made.upper, as_made.lower)};
}

void Wear::add(const SurfacePair& as_made, const cv::Mat& left_lower, const cv::Mat& left_upper) {
  lower_.add(heightsOf(as_made.lower, left_lower.size()), left_lower);
  upper_.add(heightsOf(as_made.upper, left_upper.size()), left_upper);
}

}  // namespace mems_stiction
