#include "mems_stiction/ros/half_space_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>
#include <opencv2/imgproc.hpp>

#include "mems_stiction/ros/regime_colour.hpp"
#include "mems_stiction/scan/block_maxima.hpp"

namespace mems_stiction {
namespace {

const cv::Size kSize(1000, 600);
// Of the trend beside it: light on dark.
const cv::Scalar kBackground(29, 24, 22);
const cv::Scalar kText(242, 242, 242);
const cv::Scalar kQuiet(184, 173, 168);
const cv::Scalar kGrid(74, 63, 58);
const cv::Scalar kApproachColour(255, 178, 127);
const cv::Scalar kRetractionColour(5, 183, 242);
const cv::Scalar kWarning(79, 90, 255);
constexpr double kLetters = 0.7;
constexpr int kLineHeight = 30;  // [pixels]

enum class Align { kLeft, kMiddle, kRight };

void write(cv::Mat& picture, const std::string& text, cv::Point at, const cv::Scalar& colour,
           Align align = Align::kLeft) {
  const int width = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kLetters, 1, nullptr).width;
  if (align == Align::kMiddle) at.x -= width / 2;
  if (align == Align::kRight) at.x -= width;
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, kLetters, colour, 1, cv::LINE_AA);
}

/// In lines that fit the width; returns the height that the next line would have.
int writeWrapped(cv::Mat& picture, const std::string& text, cv::Point at, int width, const cv::Scalar& colour) {
  std::string line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && cv::getTextSize(longer, cv::FONT_HERSHEY_SIMPLEX, kLetters, 1, nullptr).width > width) {
      write(picture, line, at, colour);
      at.y += kLineHeight;
      line = word;
    } else {
      line = longer;
    }
    begin = end + 1;
  }
  write(picture, line, at, colour);
  return at.y + kLineHeight;
}

/// A power of 1000 and the letter for it.
struct Prefix {
  double factor;
  const char* letter;
};

Prefix prefixOf(double largest) {
  constexpr std::array<Prefix, 6> kPrefixes = {
      {{1.0, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}, {1e-12, "p"}, {1e-15, "f"}}};
  for (const Prefix& prefix : kPrefixes) {
    if (largest >= prefix.factor) return prefix;
  }
  return kPrefixes.back();
}

std::string numberOf(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// "0.123 uN"
std::string quantity(double value, const char* unit) {
  if (!std::isfinite(value) || value == 0.0) return numberOf(value) + " " + unit;
  const Prefix prefix = prefixOf(std::abs(value));
  return numberOf(value / prefix.factor) + " " + prefix.letter + unit;
}

/// From values to pixels along one side of the plot.
class Axis {
 public:
  Axis(double low, double high, int low_pixel, int high_pixel) : low_pixel_(low_pixel), high_pixel_(high_pixel) {
    const double widest = std::max({high - low, 1e-6 * std::max(std::abs(low), std::abs(high)), 1e-30});
    low_ = low - 0.05 * widest;
    high_ = high + 0.1 * widest;  // room for a word over the summit
    prefix_ = prefixOf(std::max(std::abs(low_), std::abs(high_)));
  }

  double pixel(double value) const { return low_pixel_ + (value - low_) / (high_ - low_) * (high_pixel_ - low_pixel_); }
  const char* letter() const { return prefix_.letter; }

  /// Values at 1, 2 or 5 times a power of ten, five or a few more.
  std::vector<double> ticks() const {
    const double rough = (high_ - low_) / 5.0;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double digit = rough / decade;
    const double step = decade * (digit < 2.0 ? 1.0 : digit < 5.0 ? 2.0 : 5.0);
    std::vector<double> values;
    for (double value = std::ceil(low_ / step) * step; value <= high_; value += step) {
      values.push_back(std::abs(value) < 1e-6 * step ? 0.0 : value);
    }
    return values;
  }
  std::string label(double value) const { return numberOf(value / prefix_.factor); }

 private:
  double low_ = 0.0;
  double high_ = 1.0;
  int low_pixel_;
  int high_pixel_;
  Prefix prefix_{1.0, ""};
};

constexpr int kShift = 4;  // pixels are given in sixteenths

cv::Point fine(double x, double y) {
  const double scale = 1 << kShift;
  return {static_cast<int>(std::lround(x * scale)), static_cast<int>(std::lround(y * scale))};
}

void drawCurve(cv::Mat& picture, const HalfSpaceSolution& solution, std::uint8_t direction, const Axis& x,
               const Axis& y, const cv::Scalar& colour, int width) {
  std::vector<cv::Point> points;
  for (const HalfSpacePoint& point : solution.curve) {
    if (point.direction == direction) points.push_back(fine(x.pixel(point.height), y.pixel(point.force)));
  }
  cv::polylines(picture, points, false, colour, width, cv::LINE_AA, kShift);
}

void drawPlot(cv::Mat& picture, const HalfSpaceSolution& solution, const cv::Rect& frame) {
  const auto byHeight = [](const auto& left, const auto& right) { return left.height < right.height; };
  const auto byForce = [](const auto& left, const auto& right) { return left.force < right.force; };
  const auto heights = std::minmax_element(solution.curve.begin(), solution.curve.end(), byHeight);
  const auto forces = std::minmax_element(solution.curve.begin(), solution.curve.end(), byForce);
  const Axis x(heights.first->height, heights.second->height, frame.x, frame.x + frame.width);
  const Axis y(forces.first->force, forces.second->force, frame.y + frame.height, frame.y);
  for (const double height : x.ticks()) {
    const int at = static_cast<int>(std::lround(x.pixel(height)));
    cv::line(picture, {at, frame.y}, {at, frame.y + frame.height}, height == 0.0 ? kQuiet : kGrid);
    write(picture, x.label(height), {at, frame.y + frame.height + 24}, kQuiet, Align::kMiddle);
  }
  for (const double force : y.ticks()) {
    const int at = static_cast<int>(std::lround(y.pixel(force)));
    cv::line(picture, {frame.x, at}, {frame.x + frame.width, at}, force == 0.0 ? kQuiet : kGrid);
    write(picture, y.label(force), {frame.x - 10, at + 6}, kQuiet, Align::kRight);
  }
  cv::rectangle(picture, frame, kQuiet);
  write(picture, std::string("height over first touch [") + x.letter() + "m]",
        {frame.x + frame.width / 2, frame.y + frame.height + 52}, kText, Align::kMiddle);
  write(picture, std::string("force [") + y.letter() + "N], attraction is positive", {20, frame.y - 20}, kText);

  drawCurve(picture, solution, HalfSpacePoint::APPROACH, x, y, kApproachColour, 5);  // seen on both sides of the other
  drawCurve(picture, solution, HalfSpacePoint::RETRACTION, x, y, kRetractionColour, 2);
  const int right = frame.x + frame.width;
  write(picture, "retraction", {right, frame.y - 20}, kRetractionColour, Align::kRight);
  write(picture, "approach", {right - 140, frame.y - 20}, kApproachColour, Align::kRight);
  if (std::isnan(solution.pull_off_force)) return;
  const double mark_x = x.pixel(solution.pull_off_height);
  const double mark_y = y.pixel(solution.pull_off_force);
  cv::circle(picture, fine(mark_x, mark_y), 7 << kShift, kText, 2, cv::LINE_AA, kShift);
  const std::string text = "pull-off " + quantity(solution.pull_off_force, "N");
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kLetters, 1, nullptr);
  const int left = std::clamp(static_cast<int>(mark_x) - size.width / 2, frame.x + 8, right - size.width - 8);
  const cv::Point at(left, static_cast<int>(mark_y) - 16);
  cv::rectangle(picture, {at.x - 4, at.y - size.height - 4}, {at.x + size.width + 4, at.y + 6}, kBackground,
                cv::FILLED);
  write(picture, text, at, kText);
}

std::string figuresOf(const HalfSpaceSolution& solution) {
  if (std::isnan(solution.pull_off_force)) return "no pull-off force: " + solution.message;
  return "pull-off " + quantity(solution.pull_off_force, "N") + ", apparent work " +
         quantity(solution.apparent_work_of_adhesion, "J/m^2") + ", " + numberOf(100.0 * solution.contact_fraction) +
         " % in " + std::to_string(solution.contact_count) + (solution.contact_count == 1 ? " contact" : " contacts");
}

/// A contact map in the colours of its regimes, as large as fits, in the middle of `place`. Where pixels are fewer than
/// those of the scan, each shows the severest of its regimes, so that contacts of one pixel are seen.
void drawMap(cv::Mat& picture, const cv::Mat& map, const cv::Rect& place) {
  const double scale =
      std::min(static_cast<double>(place.width) / map.cols, static_cast<double>(place.height) / map.rows);
  cv::Mat shown = map;
  if (scale < 1.0) {
    const int factor = static_cast<int>(std::ceil(1.0 / scale));
    const auto missing = [factor](int side) { return (factor - side % factor) % factor; };
    cv::copyMakeBorder(map, shown, 0, missing(map.rows), 0, missing(map.cols), cv::BORDER_REPLICATE);
    shown = blockMaxima(shown, factor);
  }
  cv::Mat colours(shown.size(), CV_8UC3);
  for (int row = 0; row < shown.rows; ++row) {
    for (int col = 0; col < shown.cols; ++col) {
      const Colour colour = colourOf(static_cast<Regime>(shown.at<std::uint8_t>(row, col)));
      colours.at<cv::Vec3b>(row, col) = {colour.blue, colour.green, colour.red};
    }
  }
  const cv::Size size(std::max(1, static_cast<int>(map.cols * scale)), std::max(1, static_cast<int>(map.rows * scale)));
  cv::Mat fitted;
  cv::resize(colours, fitted, size, 0.0, 0.0, cv::INTER_NEAREST);
  fitted.copyTo(picture(cv::Rect(place.x + (place.width - size.width) / 2, place.y + (place.height - size.height) / 2,
                                 size.width, size.height)));
}

void drawPanel(cv::Mat& picture, const std::string& name, const cv::Mat& map, const std::string& without,
               const cv::Rect& place) {
  std::string title = name;
  if (map.empty()) {
    cv::rectangle(picture, place, kGrid);
    write(picture, without, {place.x + place.width / 2, place.y + place.height / 2}, kQuiet, Align::kMiddle);
  } else {
    title += ": " + std::to_string(cv::countNonZero(map)) + " pixels in contact";
    drawMap(picture, map, place);
  }
  write(picture, title, {place.x + place.width / 2, place.y - 14}, kText, Align::kMiddle);
}

sensor_msgs::ImagePtr imageOf(const cv::Mat& picture, const std_msgs::Header& header) {
  return cv_bridge::CvImage(header, sensor_msgs::image_encodings::BGR8, picture).toImageMsg();
}

}  // namespace

sensor_msgs::ImagePtr curvePicture(const HalfSpaceSolution& solution) {
  cv::Mat picture(kSize, CV_8UC3, kBackground);
  const int width = kSize.width - 40;
  if (solution.curve.empty()) {
    writeWrapped(picture, solution.message, {20, 40}, width, kWarning);
    return imageOf(picture, solution.header);
  }
  const bool is_solved = solution.status == HalfSpaceSolution::SOLVED;
  int top = writeWrapped(picture, figuresOf(solution), {20, 32}, width, is_solved ? kText : kWarning);
  write(picture, "load " + quantity(solution.mechanical_load, "N") + ", " + quantity(solution.voltage, "V"), {20, top},
        kQuiet);
  if (is_solved && !solution.is_resolved) {
    write(picture, "pixels are too coarse for the edges of contacts", {kSize.width - 40, top}, kWarning, Align::kRight);
  }
  top += 58;
  drawPlot(picture, solution, cv::Rect(100, top, kSize.width - 140, kSize.height - top - 70));
  return imageOf(picture, solution.header);
}

sensor_msgs::ImagePtr contactMapsPicture(const cv::Mat& model_map, const cv::Mat& half_space_map,
                                         const std_msgs::Header& header) {
  cv::Mat picture(kSize, CV_8UC3, kBackground);
  const int side = kSize.width / 2 - 20;
  const int height = kSize.height - 100;
  drawPanel(picture, "asperity model", model_map, "comes with the next scan", cv::Rect(10, 45, side, height));
  drawPanel(picture, "half-space", half_space_map, "no state at rest",
            cv::Rect(kSize.width / 2 + 10, 45, side, height));
  write(picture, kRegimeLegend, {kSize.width / 2, kSize.height - 20}, kQuiet, Align::kMiddle);
  return imageOf(picture, header);
}

}  // namespace mems_stiction
