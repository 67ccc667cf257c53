#include "ros/force_curve_picture.hpp"

#include <string>

#include "ros/picture_drawing.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
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
    writeWrapped(picture,
                 "formulation " + scan.formulation + " does not follow the force over the height",
                 {20, 40}, width, kQuietColour);
    return imageOf(picture, header);
  }
  const Prediction& prediction = scan.prediction;
  int top =
      writeWrapped(picture,
                   figuresText(prediction.pull_off_force, prediction.apparent_work_of_adhesion,
                               prediction.contact_fraction, prediction.asperity_count),
                   {20, 32}, width, kTextColour);
  write(picture,
        scan.formulation + ", load " + quantity(prediction.mechanical_load, "N") + ", " +
            quantity(prediction.voltage, "V"),
        {20, top}, kQuietColour);
  const std::string flags = regimeFlagNames(scan.verdict.regime_flags);
  if (!flags.empty())
    top = writeWrapped(picture, flags, {20, top + 30}, width, kWarningColour) - 30;
  top += 58;
  drawCurves(picture, cv::Rect(100, top, kPictureSize.width - 140, kPictureSize.height - top - 90),
             drawnCurve(scan));
  sign(picture, scan.provenance);
  return imageOf(picture, header);
}

}  // namespace mems_stiction
