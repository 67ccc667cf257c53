#pragma once

/// Clouds of points as drivers of profilometers send them, from a known surface: a cap on a tilted
/// plane, off the middle, so that a mirrored or transposed axis shows.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/PointField.h>
#include <opencv2/core.hpp>

namespace mems_stiction {
namespace clouds {

constexpr double kPitchX = 20e-6, kPitchY = 30e-6;  // [m]
constexpr int kRows = 12, kCols = 17;               // of the map

/// [m]
inline double surfaceAt(double x, double y) {
  const double dx = x - 90e-6, dy = y + 40e-6;
  return 0.01 * x - 0.02 * y + std::max(0.0, 5e-6 - 5e-6 * (dx * dx + dy * dy) / 1e-8);
}

inline double xOf(int col) { return (col - 5) * kPitchX; }
inline double yOf(int row) { return (4 - row) * kPitchY; }  // row 0 has the largest y

/// The map that every order of the points must lead to, kRows x kCols CV_64FC1.
inline cv::Mat expectedMap() {
  cv::Mat map(kRows, kCols, CV_64FC1);
  for (int row = 0; row < kRows; ++row) {
    for (int col = 0; col < kCols; ++col) map.at<double>(row, col) = surfaceAt(xOf(col), yOf(row));
  }
  return map;
}

/// The points in one of the eight orders of a grid.
inline cv::Mat orderedPoints(bool is_transposed, bool is_x_falling, bool is_y_rising) {
  cv::Mat points(kRows, kCols, CV_64FC3);
  for (int row = 0; row < kRows; ++row) {
    for (int col = 0; col < kCols; ++col) {
      const double x = xOf(is_x_falling ? kCols - 1 - col : col);
      const double y = yOf(is_y_rising ? kRows - 1 - row : row);
      points.at<cv::Vec3d>(row, col) = {x, y, surfaceAt(x, y)};
    }
  }
  if (is_transposed) cv::transpose(points, points);
  return points;
}

/// How a message holds its points.
struct Layout {
  bool is_double = false;
  bool is_foreign_order = false;
  std::uint32_t first = 0;       ///< offset of x [bytes]
  std::uint32_t point_step = 0;  ///< [bytes]; 0 = no padding
  std::uint32_t row_padding = 0;
};

inline void putNumber(std::vector<std::uint8_t>& data, std::size_t at, double value,
                      const Layout& layout) {
  std::uint8_t bytes[8];
  const std::size_t size = layout.is_double ? 8 : 4;
  const auto narrow = static_cast<float>(value);
  std::memcpy(
      bytes,
      layout.is_double ? static_cast<const void*>(&value) : static_cast<const void*>(&narrow),
      size);
  if (layout.is_foreign_order) std::reverse(bytes, bytes + size);
  std::memcpy(data.data() + at, bytes, size);
}

inline sensor_msgs::PointCloud2 message(const cv::Mat& points, const Layout& layout = {}) {
  sensor_msgs::PointCloud2 cloud;
  const std::uint32_t size = layout.is_double ? 8 : 4;
  cloud.height = static_cast<std::uint32_t>(points.rows);
  cloud.width = static_cast<std::uint32_t>(points.cols);
  cloud.point_step = layout.point_step != 0 ? layout.point_step : layout.first + 3 * size;
  cloud.row_step = cloud.point_step * cloud.width + layout.row_padding;
  cloud.is_bigendian = (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) != layout.is_foreign_order;
  for (int axis = 0; axis < 3; ++axis) {
    sensor_msgs::PointField field;
    field.name = std::string(1, static_cast<char>('x' + axis));
    field.offset = layout.first + static_cast<std::uint32_t>(axis) * size;
    field.datatype =
        layout.is_double ? sensor_msgs::PointField::FLOAT64 : sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.data.resize(std::size_t{cloud.row_step} * cloud.height, 0xAB);
  for (int row = 0; row < points.rows; ++row) {
    for (int col = 0; col < points.cols; ++col) {
      const std::size_t at = static_cast<std::size_t>(row) * cloud.row_step +
                             static_cast<std::size_t>(col) * cloud.point_step;
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        putNumber(cloud.data, at + layout.first + axis * size,
                  points.at<cv::Vec3d>(row, col)[static_cast<int>(axis)], layout);
      }
    }
  }
  return cloud;
}

}  // namespace clouds
}  // namespace mems_stiction
