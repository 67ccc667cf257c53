#include "mems_stiction/ros/display_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/ColorRGBA.h>

namespace mems_stiction {
namespace {

struct Color {
  std::uint8_t red, green, blue;
};

/// Apart gray, elastic blue, elasto-plastic orange, fully plastic red.
Color colorOf(Regime regime) {
  switch (regime) {
    case Regime::kElastic:
      return {31, 119, 180};
    case Regime::kElastoPlastic:
      return {255, 165, 0};
    case Regime::kPlastic:
      return {200, 30, 30};
    case Regime::kApart:
      break;
  }
  return {190, 190, 190};
}

double meanHeight(const cv::Mat& heights) { return heightStatistics(HeightMap(heights, 1.0, 1.0)).mean; }

/// Every how many rows and columns a point is shown.
int strideFor(const cv::Mat& heights, int max_points) {
  int stride = 1;
  const auto shown = [&](int size) { return (static_cast<std::int64_t>(size) + stride - 1) / stride; };
  while (shown(heights.rows) * shown(heights.cols) > max_points) ++stride;
  return stride;
}

}  // namespace

sensor_msgs::PointCloud2 surfacePoints(const Prediction& prediction, const HeightMap& scan,
                                       const std_msgs::Header& header, const DisplayOptions& options) {
  const cv::Mat& heights = prediction.deformed_lower;
  const double mean = meanHeight(heights);
  const int stride = strideFor(heights, options.max_points);
  std::vector<cv::Point> shown;
  for (int row = 0; row < heights.rows; row += stride) {
    for (int col = 0; col < heights.cols; col += stride) {
      if (std::isfinite(heights.at<double>(row, col))) shown.emplace_back(col, row);
    }
  }

  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.is_dense = true;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  using sensor_msgs::PointField;
  modifier.setPointCloud2Fields(5, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                PointField::FLOAT32, "height", 1, PointField::FLOAT32, "rgb", 1, PointField::FLOAT32);
  modifier.resize(shown.size());
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z"), height(cloud, "height");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> rgb(cloud, "rgb");
  for (const cv::Point& cell : shown) {
    const double above_mean = heights.at<double>(cell) - mean;
    *x = static_cast<float>(cell.x * scan.pitchX() * options.scale);
    *y = static_cast<float>(cell.y * scan.pitchY() * options.scale);
    *z = static_cast<float>(above_mean * options.scale * options.height_exaggeration);
    *height = static_cast<float>(above_mean);
    const Color color = colorOf(static_cast<Regime>(prediction.contact_map.at<std::uint8_t>(cell)));
    rgb[0] = color.blue;
    rgb[1] = color.green;
    rgb[2] = color.red;
    rgb[3] = 0;
    ++x, ++y, ++z, ++height, ++rgb;
  }
  return cloud;
}

visualization_msgs::MarkerArray asperityMarkers(const Prediction& prediction, const std_msgs::Header& header,
                                                const DisplayOptions& options) {
  std::vector<const Asperity*> shown;
  for (const Asperity& asperity : prediction.asperities) shown.push_back(&asperity);
  if (shown.size() > static_cast<std::size_t>(options.max_markers)) {
    std::stable_sort(shown.begin(), shown.end(),
                     [](const Asperity* left, const Asperity* right) { return left->load > right->load; });
    shown.resize(static_cast<std::size_t>(options.max_markers));
  }

  visualization_msgs::MarkerArray array;
  visualization_msgs::Marker clear;
  clear.header = header;
  clear.ns = "asperities";
  clear.action = visualization_msgs::Marker::DELETEALL;
  array.markers.push_back(clear);

  const double mean = meanHeight(prediction.deformed_lower);
  for (const Asperity* asperity : shown) {
    visualization_msgs::Marker disc;
    disc.header = header;
    disc.ns = clear.ns;
    disc.id = static_cast<std::int32_t>(array.markers.size());
    disc.type = visualization_msgs::Marker::CYLINDER;
    disc.action = visualization_msgs::Marker::ADD;
    disc.pose.position.x = asperity->x * options.scale;
    disc.pose.position.y = asperity->y * options.scale;
    disc.pose.position.z = (asperity->z - mean) * options.scale * options.height_exaggeration;
    disc.pose.orientation.w = 1.0;
    disc.scale.x = disc.scale.y = 2.0 * asperity->cap_radius * options.scale;
    disc.scale.z = 0.1 * disc.scale.x;
    const Color color = colorOf(asperity->regime);
    disc.color.r = static_cast<float>(color.red) / 255.0F;
    disc.color.g = static_cast<float>(color.green) / 255.0F;
    disc.color.b = static_cast<float>(color.blue) / 255.0F;
    disc.color.a = 0.8F;
    array.markers.push_back(disc);
  }
  return array;
}

}  // namespace mems_stiction
