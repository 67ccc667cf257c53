#include "mems_stiction/height_map/height_map.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "height_map/pitch.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {
namespace {

/// Two passes, so that a stage offset of millimetres does not drown nanometres of roughness.
template <typename Scalar>
HeightStatistics statisticsOf(const cv::Mat& heights) {
  HeightStatistics statistics;
  double sum = 0.0;
  for (int row = 0; row < heights.rows; ++row) {
    const Scalar* line = heights.ptr<Scalar>(row);
    for (int col = 0; col < heights.cols; ++col) {
      const double height = line[col];
      if (!std::isfinite(height)) continue;
      if (statistics.valid_count == 0) statistics.min = statistics.max = height;
      statistics.min = std::min(statistics.min, height);
      statistics.max = std::max(statistics.max, height);
      sum += height;
      ++statistics.valid_count;
    }
  }
  if (statistics.valid_count == 0) throw SurfaceError("the height map has no valid pixel");
  statistics.mean = sum / statistics.valid_count;
  if (statistics.min == statistics.max) {  // no relief, whatever the rounding of the mean
    statistics.mean = statistics.min;
    return statistics;
  }

  double squares = 0.0;
  for (int row = 0; row < heights.rows; ++row) {
    const Scalar* line = heights.ptr<Scalar>(row);
    for (int col = 0; col < heights.cols; ++col) {
      const double deviation = line[col] - statistics.mean;
      if (std::isfinite(deviation)) squares += deviation * deviation;
    }
  }
  statistics.rms_height = std::sqrt(squares / statistics.valid_count);
  return statistics;
}

}  // namespace

HeightMap::HeightMap(const cv::Mat& heights, double pitch_x, double pitch_y)
    : HeightMap(heights, pitch_x, pitch_y, nullptr) {}

HeightMap::HeightMap(const cv::Mat& heights, double pitch_x, double pitch_y, PixelOwner owner)
    : owner_(std::move(owner)), heights_(heights), pitch_x_(pitch_x), pitch_y_(pitch_y) {
  if (heights_.type() != CV_32FC1 && heights_.type() != CV_64FC1) {
    throw SurfaceError("a height map must be CV_32FC1 or CV_64FC1, got OpenCV type " +
                       std::to_string(heights_.type()));
  }
  if (heights_.dims != 2)
    throw SurfaceError("a height map must have 2 dimensions, got " + std::to_string(heights_.dims));
  if (heights_.empty()) throw SurfaceError("a height map must have at least one pixel");
  if (!isPitch(pitch_x) || !isPitch(pitch_y)) throw SurfaceError(pitchComplaint(pitch_x, pitch_y));
  const bool only_points_to_pixels = heights_.u == nullptr;
  if (only_points_to_pixels && !owner_) heights_ = heights_.clone();
  if (!only_points_to_pixels) owner_.reset();
}

HeightMap HeightMap::asDouble() const {
  if (heights_.depth() == CV_64F) return *this;
  cv::Mat wide;
  heights_.convertTo(wide, CV_64F);
  return {wide, pitch_x_, pitch_y_};
}

HeightStatistics heightStatistics(const HeightMap& surface) {
  return surface.heights().depth() == CV_32F ? statisticsOf<float>(surface.heights())
                                             : statisticsOf<double>(surface.heights());
}

}  // namespace mems_stiction
