#include "ros/force_curve_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ros/half_space_conversion.hpp"
#include "ros/half_space_pictures.hpp"

namespace mems_stiction {
namespace {

/// How many pixels of a bgr8 picture have this colour.
int pixelsOf(const sensor_msgs::Image& image, int red, int green, int blue) {
  int count = 0;
  for (std::size_t i = 0; i + 2 < image.data.size(); i += 3) {
    count +=
        image.data[i] == blue && image.data[i + 1] == green && image.data[i + 2] == red ? 1 : 0;
  }
  return count;
}

int approachPixels(const sensor_msgs::Image& image) { return pixelsOf(image, 127, 178, 255); }
int retractionPixels(const sensor_msgs::Image& image) { return pixelsOf(image, 242, 183, 5); }
int besidePixels(const sensor_msgs::Image& image) { return pixelsOf(image, 138, 201, 132); }
/// Letters are thin and blend with the background: what is redder than all else.
int warningPixels(const sensor_msgs::Image& image) {
  int count = 0;
  for (std::size_t i = 0; i + 2 < image.data.size(); i += 3) {
    count += image.data[i + 2] > 100 && image.data[i + 1] < image.data[i + 2] / 2 ? 1 : 0;
  }
  return count;
}

/// The attraction of flat surfaces, both ways; the unloading branch is the stronger one.
PredictedScan predicted() {
  PredictedScan scan;
  scan.formulation = "separation_curve";
  scan.prediction.pull_off_force = 2.02e-7;
  for (const CurveDirection direction : {CurveDirection::kApproach, CurveDirection::kRetraction}) {
    const double strength = direction == CurveDirection::kApproach ? 1e-7 : 2e-7;
    for (int i = 0; i <= 100; ++i) {
      const double height = 1e-9 - 0.8e-11 * (direction == CurveDirection::kApproach ? i : 100 - i);
      const double x = 2e-10 / height;
      scan.curve.push_back({height, strength * x * x * (3.0 - 2.0 * x), direction});
    }
  }
  return scan;
}

TEST(ForceCurvePicture, ShowsBothWaysAndTheStatedPullOffForceAtTheHighestPointOfTheWayOut) {
  const PredictedScan scan = predicted();
  const DrawnCurve curve = drawnCurve(scan);
  EXPECT_EQ(curve.name, "separation_curve");
  EXPECT_EQ(curve.pull_off_force, 2.02e-7);
  EXPECT_NEAR(curve.pull_off_height, 2e-10, 1e-12) << "3 x^2 - 2 x^3 is largest at x = 1";
  std_msgs::Header header;
  header.frame_id = "scan";
  const sensor_msgs::ImagePtr picture = forceCurvePicture(scan, header);
  EXPECT_EQ(picture->encoding, "bgr8");
  EXPECT_EQ(picture->header.frame_id, "scan");
  // lines two pixels wide and more across a plot of 860 pixels; where they cross one hides the
  // other
  EXPECT_GT(approachPixels(*picture), 400);
  EXPECT_GT(retractionPixels(*picture), 400);
  EXPECT_EQ(warningPixels(*picture), 0);
}

TEST(ForceCurvePicture, FlagsAreNamedInTheColourOfWarnings) {
  PredictedScan scan = predicted();
  scan.verdict.regime_flags = 32;
  EXPECT_GT(warningPixels(*forceCurvePicture(scan, {})), 50);
}

TEST(ForceCurvePicture, SaysWhereItComesFromAlongItsLowerEdge) {
  const auto written_below = [](const PredictedScan& scan) {
    const sensor_msgs::ImagePtr picture = forceCurvePicture(scan, {});
    const std::size_t edge = picture->data.size() - std::size_t{25} * picture->step;
    // letters are brighter than the background
    return std::count_if(picture->data.begin() + static_cast<std::ptrdiff_t>(edge),
                         picture->data.end(), [](std::uint8_t value) { return value > 100; });
  };
  PredictedScan scan = predicted();
  EXPECT_EQ(written_below(scan), 0);
  scan.provenance = {{"wafer 3", "die 12", "A-33"}, "1.2.3", "0123456789abcdef"};
  EXPECT_GT(written_below(scan), 1000);
}

TEST(ForceCurvePicture, AFormulationWithoutACurveSaysSo) {
  PredictedScan scan;
  scan.formulation = "printed";
  EXPECT_TRUE(std::isnan(drawnCurve(scan).pull_off_force));
  const sensor_msgs::ImagePtr picture = forceCurvePicture(scan, {});
  EXPECT_EQ(approachPixels(*picture) + retractionPixels(*picture), 0);
  EXPECT_EQ(picture->data.size(), forceCurvePicture(predicted(), {})->data.size());
}

TEST(ForceCurvePicture, TheHalfSpacesPictureHasItUnderItsOwnCurve) {
  SolvedHalfSpace solved;
  for (int i = 0; i <= 100; ++i) {
    ForcePoint point;
    point.height = 1e-10 + 0.5e-11 * i;
    point.force = 3e-7 * (1.0 - 0.01 * i);
    solved.retraction.push_back(point);
  }
  const HalfSpaceSolution solution = halfSpaceMessage(solved, LoadOptions(), {});
  EXPECT_EQ(besidePixels(*curvePicture(solution)), 0);
  EXPECT_GT(besidePixels(*curvePicture(solution, drawnCurve(predicted()))), 200);
}

}  // namespace
}  // namespace mems_stiction
