#include "ros/curve_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <opencv2/imgproc.hpp>

#include "errors/short_number.hpp"
#include "ros/picture_drawing.hpp"

namespace mems_stiction {
namespace {

const cv::Scalar kApproachColour(255, 178, 127);
const cv::Scalar kRetractionColour(5, 183, 242);
const cv::Scalar kBesideColour(132, 201, 138);

/// From values to pixels along one side of the plot.
class Axis {
 public:
  Axis(double low, double high, int low_pixel, int high_pixel)
      : low_pixel_(low_pixel), high_pixel_(high_pixel) {
    const double widest =
        std::max({high - low, 1e-6 * std::max(std::abs(low), std::abs(high)), 1e-30});
    low_ = low - 0.05 * widest;
    high_ = high + 0.1 * widest;  // room for a word over the summit
    prefix_ = prefixOf(std::max(std::abs(low_), std::abs(high_)));
  }

  double pixel(double value) const {
    return low_pixel_ + (value - low_) / (high_ - low_) * (high_pixel_ - low_pixel_);
  }
  bool shows(double value) const { return value >= low_ && value <= high_; }
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
  std::string label(double value) const { return shortNumber(value / prefix_.factor); }

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

void drawWay(cv::Mat& picture, const std::vector<CurvePoint>& curve, CurveDirection direction,
             const Axis& x, const Axis& y, const cv::Scalar& colour, int width) {
  std::vector<cv::Point> points;
  for (const CurvePoint& point : curve) {
    if (point.direction == direction && x.shows(point.height)) {
      points.push_back(fine(x.pixel(point.height), y.pixel(point.force)));
    }
  }
  cv::polylines(picture, points, false, colour, width, cv::LINE_AA, kShift);
}

void drawAxes(cv::Mat& picture, const cv::Rect& frame, const Axis& x, const Axis& y) {
  for (const double height : x.ticks()) {
    const int at = static_cast<int>(std::lround(x.pixel(height)));
    cv::line(picture, {at, frame.y}, {at, frame.y + frame.height},
             height == 0.0 ? kQuietColour : kGridColour);
    write(picture, x.label(height), {at, frame.y + frame.height + 24}, kQuietColour,
          Align::kMiddle);
  }
  for (const double force : y.ticks()) {
    const int at = static_cast<int>(std::lround(y.pixel(force)));
    cv::line(picture, {frame.x, at}, {frame.x + frame.width, at},
             force == 0.0 ? kQuietColour : kGridColour);
    write(picture, y.label(force), {frame.x - 10, at + 6}, kQuietColour, Align::kRight);
  }
  cv::rectangle(picture, frame, kQuietColour);
  write(picture, std::string("height over first touch [") + x.letter() + "m]",
        {frame.x + frame.width / 2, frame.y + frame.height + 52}, kTextColour, Align::kMiddle);
  write(picture, std::string("force [") + y.letter() + "N], attraction is positive",
        {20, frame.y - 20}, kTextColour);
}

void drawLegend(cv::Mat& picture, int right, int height, const std::string& beside) {
  write(picture, "retraction", {right, height}, kRetractionColour, Align::kRight);
  write(picture, "approach", {right - 140, height}, kApproachColour, Align::kRight);
  write(picture, beside, {right - 270, height}, kBesideColour, Align::kRight);
}

}  // namespace

void drawCurves(cv::Mat& picture, const cv::Rect& frame, const DrawnCurve& curve,
                const DrawnCurve& beside) {
  const auto byHeight = [](const auto& left, const auto& right) {
    return left.height < right.height;
  };
  const auto byForce = [](const auto& left, const auto& right) { return left.force < right.force; };
  const auto heights = std::minmax_element(curve.points.begin(), curve.points.end(), byHeight);
  const Axis x(heights.first->height, heights.second->height, frame.x, frame.x + frame.width);
  std::vector<CurvePoint> shown = curve.points;
  std::copy_if(beside.points.begin(), beside.points.end(), std::back_inserter(shown),
               [&x](const CurvePoint& point) { return x.shows(point.height); });
  const auto forces = std::minmax_element(shown.begin(), shown.end(), byForce);
  const Axis y(forces.first->force, forces.second->force, frame.y + frame.height, frame.y);
  drawAxes(picture, frame, x, y);
  const int right = frame.x + frame.width;
  const cv::Point2d mark(x.pixel(curve.pull_off_height), y.pixel(curve.pull_off_force));
  const bool is_marked = !std::isnan(curve.pull_off_force);
  if (is_marked) {  // below the lines, which it would hide
    writeLabel(picture, "pull-off " + quantity(curve.pull_off_force, "N"),
               {static_cast<int>(mark.x), static_cast<int>(mark.y) - 16}, frame.x, right);
  }
  for (const CurveDirection direction : {CurveDirection::kApproach, CurveDirection::kRetraction}) {
    drawWay(picture, beside.points, direction, x, y, kBesideColour, 2);
  }
  // seen on both sides of the other
  drawWay(picture, curve.points, CurveDirection::kApproach, x, y, kApproachColour, 5);
  drawWay(picture, curve.points, CurveDirection::kRetraction, x, y, kRetractionColour, 2);
  drawLegend(picture, right, frame.y - 20, beside.points.empty() ? "" : beside.name);
  if (is_marked)
    cv::circle(picture, fine(mark.x, mark.y), 7 << kShift, kTextColour, 2, cv::LINE_AA, kShift);
}

}  // namespace mems_stiction
