#include "mems_stiction/ros/display_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

#include <sensor_msgs/image_encodings.h>
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

/// Low dark, high bright, over three rms heights to either side.
Color grayOf(double above_mean, double rms_height) {
  const double level = rms_height > 0.0 ? std::min(std::max(above_mean / (3.0 * rms_height), -1.0), 1.0) : 0.0;
  const auto gray = static_cast<std::uint8_t>(140.0 + 100.0 * level);
  return {gray, gray, gray};
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
  const HeightStatistics statistics = heightStatistics(HeightMap(heights, 1.0, 1.0));
  const double mean = statistics.mean;
  const double rms_height = statistics.rms_height;
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
    const auto regime = static_cast<Regime>(prediction.contact_map.at<std::uint8_t>(cell));
    const Color color = regime == Regime::kApart ? grayOf(above_mean, rms_height) : colorOf(regime);
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
    disc.scale.x = disc.scale.y = std::max(2.0 * asperity->cap_radius * options.scale, options.min_marker_diameter);
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

sensor_msgs::Image previewImage(const HeightMap& surface, const std_msgs::Header& header,
                                const DisplayOptions& options) {
  const cv::Mat heights = surface.asDouble().heights();
  const int longest = std::max(heights.rows, heights.cols);
  const int stride = (longest + options.max_preview_size - 1) / options.max_preview_size;
  sensor_msgs::Image image;
  image.header = header;
  image.encoding = sensor_msgs::image_encodings::MONO8;
  image.height = static_cast<std::uint32_t>((heights.rows + stride - 1) / stride);
  image.width = static_cast<std::uint32_t>((heights.cols + stride - 1) / stride);
  image.step = image.width;

  std::vector<double> shown;
  for (int row = 0; row < heights.rows; row += stride) {
    for (int col = 0; col < heights.cols; col += stride) shown.push_back(heights.at<double>(row, col));
  }
  std::vector<double> sorted;
  std::copy_if(shown.begin(), shown.end(), std::back_inserter(sorted),
               [](double height) { return std::isfinite(height); });
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted.empty() ? 0.0 : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  const double low = at(0.01);
  const double range = std::max(at(0.99) - low, 1e-15);  // a flat surface is dark
  for (const double height : shown) {
    const double level =
        std::isfinite(height) ? 1.0 + 254.0 * std::min(std::max((height - low) / range, 0.0), 1.0) : 0.0;
    image.data.push_back(static_cast<std::uint8_t>(std::lround(level)));
  }
  return image;
}

}  // namespace mems_stiction
