#include "ros/force_curve_picture.hpp"

#include <string>

#include "errors/short_number.hpp"
#include "ros/picture_drawing.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

std::string figuresOf(const PredictedScan& scan) {
  const Prediction& prediction = scan.prediction;
  return "pull-off " + quantity(prediction.pull_off_force, "N") + ", apparent work " +
         quantity(prediction.apparent_work_of_adhesion, "J/m^2") + ", " +
         shortNumber(100.0 * prediction.contact_fraction) + " % in " + std::to_string(prediction.asperity_count) +
         (prediction.asperity_count == 1 ? " contact" : " contacts");
}

}  // namespace

DrawnCurve drawnCurve(const PredictedScan& scan) {
  DrawnCurve curve;
  curve.name = scan.formulation;
  curve.points = scan.curve;
  double largest = 0.0;
  for (const CurvePoint& point : scan.curve) {
    if (point.direction != CurveDirection::kRetraction || point.force <= largest) continue;
    largest = point.force;
    curve.pull_off_force = scan.prediction.pull_off_force;
    curve.pull_off_height = point.height;
  }
  return curve;
}

sensor_msgs::ImagePtr forceCurvePicture(const PredictedScan& scan, const std_msgs::Header& header) {
  cv::Mat picture(kPictureSize, CV_8UC3, kBackgroundColour);
  const int width = kPictureSize.width - 40;
  if (scan.curve.empty()) {
    writeWrapped(picture, "formulation " + scan.formulation + " does not follow the force over the height", {20, 40},
                 width, kQuietColour);
    return imageOf(picture, header);
  }
  int top = writeWrapped(picture, figuresOf(scan), {20, 32}, width, kTextColour);
  write(picture,
        scan.formulation + ", load " + quantity(scan.prediction.mechanical_load, "N") + ", " +
            quantity(scan.prediction.voltage, "V"),
        {20, top}, kQuietColour);
  const std::string flags = regimeFlagNames(scan.verdict.regime_flags);
  if (!flags.empty()) top = writeWrapped(picture, flags, {20, top + 30}, width, kWarningColour) - 30;
  top += 58;
  drawCurves(picture, cv::Rect(100, top, kPictureSize.width - 140, kPictureSize.height - top - 90), drawnCurve(scan));
  sign(picture, scan.provenance);
  return imageOf(picture, header);
}

}  // namespace mems_stiction
