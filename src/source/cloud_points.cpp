#include "source/cloud_points.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include <sensor_msgs/PointField.h>
#include <tf2/LinearMath/Matrix3x3.h>

#include "errors/one_line.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

using sensor_msgs::PointField;

constexpr bool kIsBigEndianHere = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

/// Where a coordinate lies within a point.
struct Coordinate {
  std::size_t offset;
  bool is_double;
};

Coordinate coordinateOf(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  const auto found = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&](const PointField& field) { return field.name == name; });
  if (found == cloud.fields.end()) {
    std::string names;
    for (const PointField& field : cloud.fields) names += (names.empty() ? "" : ", ") + field.name;
    throw SurfaceError("the cloud has no field '" + name + "', but " +
                       (names.empty() ? "none at all" : shortened(names, kLongestQuotation)));
  }
  if (found->datatype != PointField::FLOAT32 && found->datatype != PointField::FLOAT64) {
    throw SurfaceError("field '" + name + "' has the type " + std::to_string(found->datatype) +
                       ", must be FLOAT32 (7) or FLOAT64 (8)");
  }
  const Coordinate coordinate = {found->offset, found->datatype == PointField::FLOAT64};
  if (coordinate.offset + (coordinate.is_double ? 8 : 4) > cloud.point_step) {
    throw SurfaceError("field '" + name + "' at offset " + std::to_string(found->offset) +
                       " lies beyond point_step " + std::to_string(cloud.point_step));
  }
  return coordinate;
}

void checkSizes(const sensor_msgs::PointCloud2& cloud) {
  const auto must = [](const std::string& what, std::uint64_t is, std::uint64_t least) {
    if (is >= least) return;
    throw SurfaceError(what + " is " + std::to_string(is) + ", must be at least " +
                       std::to_string(least));
  };
  must("the number of points of the cloud", std::uint64_t{cloud.width} * cloud.height, 1);
  checkPixelCount(cloud.width, cloud.height);
  must("point_step", cloud.point_step, 1);
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.height > 1) must("row_step", cloud.row_step, row);
  const std::uint64_t step = cloud.height > 1 ? cloud.row_step : row;
  must("the size of data", cloud.data.size(), step * (cloud.height - 1) + row);
}

template <typename Number>
double numberAt(const std::uint8_t* bytes, bool is_foreign_order) {
  std::array<std::uint8_t, sizeof(Number)> ordered;
  std::memcpy(ordered.data(), bytes, sizeof(Number));
  if (is_foreign_order) std::reverse(ordered.begin(), ordered.end());
  Number number;
  std::memcpy(&number, ordered.data(), sizeof(Number));
  return static_cast<double>(number);
}

}  // namespace

cv::Mat cloudPoints(const sensor_msgs::PointCloud2& cloud) {
  checkSizes(cloud);
  const std::array<Coordinate, 3> coordinates = {coordinateOf(cloud, "x"), coordinateOf(cloud, "y"),
                                                 coordinateOf(cloud, "z")};
  const bool is_foreign_order = (cloud.is_bigendian != 0) != kIsBigEndianHere;
  const std::size_t row_step = cloud.height > 1 ? cloud.row_step : 0;
  cv::Mat points(static_cast<int>(cloud.height), static_cast<int>(cloud.width), CV_64FC3);
  for (int row = 0; row < points.rows; ++row) {
    const std::uint8_t* point = cloud.data.data() + row_step * static_cast<std::size_t>(row);
    auto* target = points.ptr<cv::Vec3d>(row);
    for (int col = 0; col < points.cols; ++col, point += cloud.point_step) {
      for (int axis = 0; axis < 3; ++axis) {
        const Coordinate& one = coordinates[static_cast<std::size_t>(axis)];
        const std::uint8_t* bytes = point + one.offset;
        target[col][axis] = one.is_double ? numberAt<double>(bytes, is_foreign_order)
                                          : numberAt<float>(bytes, is_foreign_order);
      }
    }
  }
  return points;
}

void transformPoints(const geometry_msgs::Transform& transform, cv::Mat& points) {
  const auto& turn = transform.rotation;
  const auto& shift = transform.translation;
  const tf2::Matrix3x3 rotation(tf2::Quaternion(turn.x, turn.y, turn.z, turn.w).normalized());
  cv::Matx34d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) matrix(row, col) = rotation[row][col];
  }
  matrix(0, 3) = shift.x;
  matrix(1, 3) = shift.y;
  matrix(2, 3) = shift.z;
  cv::transform(points, points, matrix);
}

}  // namespace mems_stiction
