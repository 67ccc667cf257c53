#include "ros/display_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/ColorRGBA.h>

#include "errors/plain_format.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "numeric/rounding.hpp"

namespace mems_stiction {
namespace {

constexpr char kRegimeLegend[] =
    "grey: apart   blue: elastic   yellow: elasto-plastic   red: plastic";

/// Of a picture's pixel, 0 to 255 each.
struct Colour {
  std::uint8_t red, green, blue;
};

/// Of deformation regimes, as in all our pictures: told apart without red-green vision too.
Colour colourOf(Regime regime) {
  switch (regime) {
    case Regime::kElastic:
      return {47, 127, 209};
    case Regime::kElastoPlastic:
      return {242, 183, 5};
    case Regime::kPlastic:
      return {209, 50, 47};
    case Regime::kApart:
      break;
  }
  return {190, 190, 190};
}

/// Low dark, high bright, over three rms heights to either side.
Colour greyOf(double above_mean, double rms_height) {
  const double level =
      rms_height > 0.0 ? std::min(std::max(above_mean / (3.0 * rms_height), -1.0), 1.0) : 0.0;
  const auto grey = static_cast<std::uint8_t>(140.0 + 100.0 * level);
  return {grey, grey, grey};
}

/// Share of the longer side that the rms height gets on the screen: relief that is seen and hides
/// nothing.
constexpr double kReliefShare = 0.015;
constexpr double kTextHeight = 0.35;  // [m on the screen]

/// "600 nm", "1.95 um": what a line of text can show.
std::string lengthText(double length) {
  return length < 1e-6 ? plainFormat("%.3g nm", length * 1e9)
                       : plainFormat("%.3g um", length * 1e6);
}

/// From the scan to the screen.
class View {
 public:
  View(const cv::Mat& heights, const HeightMap& scan, const std_msgs::Header& scan_header,
       const DisplayOptions& options)
      : header(scan_header),
        width_(heights.cols * scan.pitchX()),
        height_(heights.rows * scan.pitchY()),
        middle_x_(0.5 * (heights.cols - 1) * scan.pitchX()),
        middle_y_(0.5 * (heights.rows - 1) * scan.pitchY()) {
    if (!options.frame.empty()) header.frame_id = options.frame;
    const HeightStatistics statistics = heightStatistics(HeightMap(heights, 1.0, 1.0));
    mean = statistics.mean;
    rms_height = statistics.rms_height;
    const double longer = std::max(width_, height_);
    scale = options.scale > 0.0 ? options.scale : kViewSize / longer;
    exaggeration_ = options.height_exaggeration;
    if (exaggeration_ == 0.0)
      exaggeration_ = rms_height > 0.0 ? roundedDown(kReliefShare * longer / rms_height) : 1.0;
  }

  double x(double along_columns) const { return (along_columns - middle_x_) * scale; }
  double y(double along_rows) const { return (middle_y_ - along_rows) * scale; }
  double z(double height) const { return (height - mean) * scale * exaggeration_; }
  /// Of the lower edge [m on the screen].
  double bottom() const { return -0.5 * height_ * scale; }

  std::string text() const {
    return lengthText(width_) + " x " + lengthText(height_) + ", heights x " +
           plainFormat("%.3g", exaggeration_) + ", rms " + lengthText(rms_height);
  }

  std_msgs::Header header;
  double mean = 0.0;        ///< of the heights [m]
  double rms_height = 0.0;  ///< [m]
  double scale = 1.0;

 private:
  double width_, height_, middle_x_, middle_y_;  ///< of the scan [m]
  double exaggeration_ = 1.0;
};

/// Every how many rows and columns a point is shown.
int strideFor(const cv::Mat& heights, int max_points) {
  int stride = 1;
  const auto shown = [&](int size) {
    return (static_cast<std::int64_t>(size) + stride - 1) / stride;
  };
  while (shown(heights.rows) * shown(heights.cols) > max_points) ++stride;
  return stride;
}

/// Square pixels over the scan, each of which shows the scan's pixel below it, so that the picture
/// has the scan's true aspect. They are as large as the smaller pitch, or a whole number of times
/// where that would be too many.
class PreviewGrid {
 public:
  PreviewGrid(const HeightMap& scan, int max_size)
      : scan_rows_(scan.rows()), scan_cols_(scan.cols()) {
    const double pitch = std::min(scan.pitchX(), scan.pitchY());
    const double longer =
        std::max(scan.cols() * (scan.pitchX() / pitch), scan.rows() * (scan.pitchY() / pitch));
    const double stride = std::max(1.0, std::ceil(longer / max_size - kRoundOff));
    step_x_ = stride * (pitch / scan.pitchX());
    step_y_ = stride * (pitch / scan.pitchY());
  }

  int rows() const { return count(scan_rows_, step_y_); }
  int cols() const { return count(scan_cols_, step_x_); }
  int scanRow(int row) const { return place(row, step_y_, scan_rows_); }
  int scanCol(int col) const { return place(col, step_x_, scan_cols_); }

 private:
  static constexpr double kRoundOff = 1e-9;

  static int count(int size, double step) {
    return std::max(1, static_cast<int>(std::ceil(size / step - kRoundOff)));
  }
  static int place(int pixel, double step, int size) {
    return std::min(static_cast<int>(pixel * step + kRoundOff), size - 1);
  }

  int scan_rows_, scan_cols_;
  double step_x_ = 1.0;  ///< [pixels of the scan]
  double step_y_ = 1.0;
};

/// Heights from dark to bright [m].
struct GreyRange {
  double low = 0.0;
  double high = 0.0;
  double mean = 0.0;
};

GreyRange greyRange(const std::vector<double>& heights, double stated) {
  std::vector<double> sorted;
  std::copy_if(heights.begin(), heights.end(), std::back_inserter(sorted),
               [](double height) { return std::isfinite(height); });
  if (sorted.empty()) return {0.0, 1e-15, 0.0};
  std::sort(sorted.begin(), sorted.end());
  GreyRange range;
  for (const double height : sorted)
    range.mean += (height - sorted.front()) / static_cast<double>(sorted.size());
  range.mean += sorted.front();
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  range.low = stated > 0.0 ? range.mean - 0.5 * stated : at(0.01);
  range.high =
      stated > 0.0 ? range.mean + 0.5 * stated : range.low + std::max(at(0.99) - range.low, 1e-15);
  return range;  // a flat surface is dark
}

constexpr int kBarGap = 4;           // pixels
constexpr int kBarWidth = 12;        // pixels
constexpr int kBarTextWidth = 84;    // pixels
constexpr int kLeastBarHeight = 40;  // pixels: three lines of text
constexpr double kBarTextScale = 0.35;

/// The picture with a bar to its right: bright at the top, with the heights above the mean of both
/// ends and of the middle.
void addBar(const GreyRange& range, sensor_msgs::Image& image) {
  const cv::Mat picture(static_cast<int>(image.height), static_cast<int>(image.width), CV_8UC1,
                        image.data.data());
  const int height = std::max(picture.rows, kLeastBarHeight);
  cv::Mat with_bar(height, picture.cols + kBarGap + kBarWidth + kBarTextWidth, CV_8UC1,
                   cv::Scalar(0));
  picture.copyTo(with_bar(cv::Rect(0, 0, picture.cols, picture.rows)));
  const int left = picture.cols + kBarGap;
  for (int row = 0; row < height; ++row) {
    const double grey = 255.0 - 254.0 * row / (height - 1);
    with_bar(cv::Rect(left, row, kBarWidth, 1)).setTo(std::lround(grey));
  }
  const double span = range.high - range.low;
  for (const double share : {0.0, 0.5, 1.0}) {
    const double above_mean = range.high - share * span - range.mean;
    const bool is_mean = std::abs(above_mean) < 0.01 * span;
    const std::string sign = above_mean < 0.0 && !is_mean ? "-" : "";
    const int baseline = 10 + static_cast<int>(std::lround(share * (height - 13)));
    cv::putText(with_bar, sign + lengthText(is_mean ? 0.0 : std::abs(above_mean)),
                cv::Point(left + kBarWidth + kBarGap, baseline), cv::FONT_HERSHEY_SIMPLEX,
                kBarTextScale, cv::Scalar(255));
  }
  image.height = static_cast<std::uint32_t>(with_bar.rows);
  image.width = static_cast<std::uint32_t>(with_bar.cols);
  image.step = image.width;
  image.data.assign(with_bar.datastart, with_bar.dataend);
}

}  // namespace

sensor_msgs::PointCloud2 surfacePoints(const Prediction& prediction, const HeightMap& scan,
                                       const std_msgs::Header& header,
                                       const DisplayOptions& options) {
  const cv::Mat& heights = prediction.deformed_lower;
  const View view(heights, scan, header, options);
  const int stride = strideFor(heights, options.max_points);
  std::vector<cv::Point> shown;
  for (int row = 0; row < heights.rows; row += stride) {
    for (int col = 0; col < heights.cols; col += stride) {
      if (std::isfinite(heights.at<double>(row, col))) shown.emplace_back(col, row);
    }
  }

  sensor_msgs::PointCloud2 cloud;
  cloud.header = view.header;
  cloud.is_dense = true;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  using sensor_msgs::PointField;
  modifier.setPointCloud2Fields(5, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                PointField::FLOAT32, "height", 1, PointField::FLOAT32, "rgb", 1,
                                PointField::FLOAT32);
  modifier.resize(shown.size());
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z"),
      height(cloud, "height");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> rgb(cloud, "rgb");
  for (const cv::Point& cell : shown) {
    const double above_mean = heights.at<double>(cell) - view.mean;
    *x = static_cast<float>(view.x(cell.x * scan.pitchX()));
    *y = static_cast<float>(view.y(cell.y * scan.pitchY()));
    *z = static_cast<float>(view.z(heights.at<double>(cell)));
    *height = static_cast<float>(above_mean);
    const auto regime = static_cast<Regime>(prediction.contact_map.at<std::uint8_t>(cell));
    const Colour colour =
        regime == Regime::kApart ? greyOf(above_mean, view.rms_height) : colourOf(regime);
    rgb[0] = colour.blue;
    rgb[1] = colour.green;
    rgb[2] = colour.red;
    rgb[3] = 0;
    ++x, ++y, ++z, ++height, ++rgb;
  }
  return cloud;
}

visualization_msgs::MarkerArray asperityMarkers(const Prediction& prediction, const HeightMap& scan,
                                                const std_msgs::Header& header,
                                                const DisplayOptions& options) {
  const View view(prediction.deformed_lower, scan, header, options);
  std::vector<const Asperity*> shown;
  shown.reserve(prediction.asperities.size());
  for (const Asperity& asperity : prediction.asperities) shown.push_back(&asperity);
  if (shown.size() > static_cast<std::size_t>(options.max_markers)) {
    std::stable_sort(shown.begin(), shown.end(), [](const Asperity* left, const Asperity* right) {
      return left->load > right->load;
    });
    shown.resize(static_cast<std::size_t>(options.max_markers));
  }

  visualization_msgs::MarkerArray array;
  visualization_msgs::Marker clear;
  clear.header = view.header;
  clear.ns = "asperities";
  clear.action = visualization_msgs::Marker::DELETEALL;
  array.markers.push_back(clear);

  visualization_msgs::Marker text;
  text.header = view.header;
  text.ns = "size";
  text.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  text.action = visualization_msgs::Marker::ADD;
  text.pose.position.y = view.bottom() - 2.5 * kTextHeight;
  text.pose.orientation.w = 1.0;
  text.scale.z = kTextHeight;
  text.color.r = text.color.g = text.color.b = text.color.a = 1.0F;
  text.text = view.text() + "\n" + kRegimeLegend;
  array.markers.push_back(text);

  for (const Asperity* asperity : shown) {
    visualization_msgs::Marker disc;
    disc.header = view.header;
    disc.ns = clear.ns;
    disc.id = static_cast<std::int32_t>(array.markers.size());
    disc.type = visualization_msgs::Marker::CYLINDER;
    disc.action = visualization_msgs::Marker::ADD;
    disc.pose.position.x = view.x(asperity->x);
    disc.pose.position.y = view.y(asperity->y);
    disc.pose.position.z = view.z(asperity->z);
    disc.pose.orientation.w = 1.0;
    disc.scale.x = disc.scale.y =
        std::max(2.0 * asperity->cap_radius * view.scale, options.min_marker_diameter);
    disc.scale.z = 0.1 * disc.scale.x;
    const Colour colour = colourOf(asperity->regime);
    disc.color.r = static_cast<float>(colour.red) / 255.0F;
    disc.color.g = static_cast<float>(colour.green) / 255.0F;
    disc.color.b = static_cast<float>(colour.blue) / 255.0F;
    disc.color.a = 0.8F;
    array.markers.push_back(disc);
  }
  return array;
}

sensor_msgs::Image previewImage(const HeightMap& surface, const std_msgs::Header& header,
                                const DisplayOptions& options) {
  const cv::Mat heights = surface.asDouble().heights();
  const PreviewGrid grid(surface, options.max_preview_size);
  sensor_msgs::Image image;
  image.header = header;
  image.encoding = sensor_msgs::image_encodings::MONO8;
  image.height = static_cast<std::uint32_t>(grid.rows());
  image.width = static_cast<std::uint32_t>(grid.cols());
  image.step = image.width;

  std::vector<double> shown;
  for (int row = 0; row < grid.rows(); ++row) {
    const double* line = heights.ptr<double>(grid.scanRow(row));
    for (int col = 0; col < grid.cols(); ++col) shown.push_back(line[grid.scanCol(col)]);
  }
  const GreyRange range = greyRange(shown, options.preview_range);
  for (const double height : shown) {
    const double share = (height - range.low) / (range.high - range.low);
    const double level =
        std::isfinite(height) ? 1.0 + 254.0 * std::min(std::max(share, 0.0), 1.0) : 0.0;
    image.data.push_back(static_cast<std::uint8_t>(std::lround(level)));
  }
  if (options.preview_bar) addBar(range, image);
  return image;
}

}  // namespace mems_stiction
