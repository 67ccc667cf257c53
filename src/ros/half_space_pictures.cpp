#include "ros/half_space_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <opencv2/imgproc.hpp>

#include "evaluation/block_maxima.hpp"
#include "ros/message_parts.hpp"
#include "ros/picture_drawing.hpp"
#include "ros/regime_colour.hpp"

namespace mems_stiction {
namespace {

DrawnCurve drawnCurve(const HalfSpaceSolution& solution) {
  DrawnCurve curve;
  curve.pull_off_force = solution.pull_off_force;
  curve.pull_off_height = solution.pull_off_height;
  for (const HalfSpacePoint& point : solution.curve) {
    curve.points.push_back({point.height, point.force,
                            point.direction == HalfSpacePoint::APPROACH
                                ? CurveDirection::kApproach
                                : CurveDirection::kRetraction});
  }
  return curve;
}

std::string figuresOf(const HalfSpaceSolution& solution) {
  if (std::isnan(solution.pull_off_force)) return "no pull-off force: " + solution.message;
  return figuresText(solution.pull_off_force, solution.apparent_work_of_adhesion,
                     solution.contact_fraction, solution.contact_count);
}

/// A contact map in the colours of its regimes, as large as fits, in the middle of `place`. Where
/// pixels are fewer than those of the scan, each shows the severest of its regimes, so that
/// contacts of one pixel are seen.
void drawMap(cv::Mat& picture, const cv::Mat& map, const cv::Rect& place) {
  const double scale = std::min(static_cast<double>(place.width) / map.cols,
                                static_cast<double>(place.height) / map.rows);
  cv::Mat shown = map;
  if (scale < 1.0) {
    const int factor = static_cast<int>(std::ceil(1.0 / scale));
    const auto missing = [factor](int side) { return (factor - side % factor) % factor; };
    cv::copyMakeBorder(map, shown, 0, missing(map.rows), 0, missing(map.cols),
                       cv::BORDER_REPLICATE);
    shown = blockMaxima(shown, factor);
  }
  cv::Mat colours(shown.size(), CV_8UC3);
  for (int row = 0; row < shown.rows; ++row) {
    for (int col = 0; col < shown.cols; ++col) {
      const Colour colour = colourOf(static_cast<Regime>(shown.at<std::uint8_t>(row, col)));
      colours.at<cv::Vec3b>(row, col) = {colour.blue, colour.green, colour.red};
    }
  }
  const cv::Size size(std::max(1, static_cast<int>(map.cols * scale)),
                      std::max(1, static_cast<int>(map.rows * scale)));
  cv::Mat fitted;
  cv::resize(colours, fitted, size, 0.0, 0.0, cv::INTER_NEAREST);
  fitted.copyTo(
      picture(cv::Rect(place.x + (place.width - size.width) / 2,
                       place.y + (place.height - size.height) / 2, size.width, size.height)));
}

void drawPanel(cv::Mat& picture, const std::string& name, const cv::Mat& map,
               const std::string& without, const cv::Rect& place) {
  std::string title = name;
  if (map.empty()) {
    cv::rectangle(picture, place, kGridColour);
    write(picture, without, {place.x + place.width / 2, place.y + place.height / 2}, kQuietColour,
          Align::kMiddle);
  } else {
    title += ": " + std::to_string(cv::countNonZero(map)) + " pixels in contact";
    drawMap(picture, map, place);
  }
  write(picture, title, {place.x + place.width / 2, place.y - 14}, kTextColour, Align::kMiddle);
}

}  // namespace

sensor_msgs::ImagePtr curvePicture(const HalfSpaceSolution& solution, const DrawnCurve& beside) {
  cv::Mat picture(kPictureSize, CV_8UC3, kBackgroundColour);
  sign(picture, provenanceIn(solution));
  const int width = kPictureSize.width - 40;
  if (solution.curve.empty()) {
    writeWrapped(picture, solution.message, {20, 40}, width, kWarningColour);
    return imageOf(picture, solution.header);
  }
  const bool is_solved = solution.status == HalfSpaceSolution::SOLVED;
  int top = writeWrapped(picture, figuresOf(solution), {20, 32}, width,
                         is_solved ? kTextColour : kWarningColour);
  write(picture,
        "load " + quantity(solution.mechanical_load, "N") + ", " + quantity(solution.voltage, "V"),
        {20, top}, kQuietColour);
  if (is_solved && !solution.is_resolved) {
    write(picture, "pixels are too coarse for the edges of contacts",
          {kPictureSize.width - 40, top}, kWarningColour, Align::kRight);
  }
  top += 58;
  drawCurves(picture, cv::Rect(100, top, kPictureSize.width - 140, kPictureSize.height - top - 90),
             drawnCurve(solution), beside);
  return imageOf(picture, solution.header);
}

sensor_msgs::ImagePtr contactMapsPicture(const cv::Mat& model_map, const cv::Mat& half_space_map,
                                         const HalfSpaceSolution& solution) {
  cv::Mat picture(kPictureSize, CV_8UC3, kBackgroundColour);
  sign(picture, provenanceIn(solution));
  const int side = kPictureSize.width / 2 - 20;
  const int height = kPictureSize.height - 115;
  drawPanel(picture, "prediction", model_map, "comes with the next scan",
            cv::Rect(10, 45, side, height));
  drawPanel(picture, "half-space", half_space_map, "no state at rest",
            cv::Rect(kPictureSize.width / 2 + 10, 45, side, height));
  write(picture, kRegimeLegend, {kPictureSize.width / 2, kPictureSize.height - 36}, kQuietColour,
        Align::kMiddle);
  return imageOf(picture, solution.header);
}

}  // namespace mems_stiction
