#include "surface/alignment.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

HeightMap rough(int rows, int cols) {
  GaussianSurfaceOptions options;
  options.rows = rows;
  options.cols = cols;
  return gaussianSurface(options);
}

double largestDifference(const cv::Mat& first, const cv::Mat& second) {
  cv::Mat difference = cv::abs(first - second);
  difference.setTo(0.0, ~validMask(difference));
  double largest = 0.0;
  cv::minMaxLoc(difference, nullptr, &largest);
  return largest;
}

TEST(Alignment, onTheSameGridIsTheSameSurfaceToTheBit) {
  const HeightMap surface = analytic::withInvalidPixel(rough(60, 81), 20, 30);
  const HeightMap found = alignedTo(surface, surface, SurfacePose());
  EXPECT_EQ(heightStatistics(found).valid_count, 60 * 81 - 1);
  EXPECT_EQ(largestDifference(found.heights(), surface.heights()), 0.0);
}

TEST(Alignment, anOffsetOfWholePixelsMovesIt) {
  const HeightMap surface = rough(60, 80);
  SurfacePose pose;
  pose.offset_x = 3 * surface.pitchX();
  pose.offset_y = -5 * surface.pitchY();
  const HeightMap moved = alignedTo(surface, surface, pose);
  EXPECT_NEAR(moved.height(20, 40), surface.height(25, 37), 1e-22);
  EXPECT_TRUE(std::isnan(moved.height(20, 2)));
  EXPECT_TRUE(std::isnan(moved.height(55, 40)));
  EXPECT_EQ(heightStatistics(moved).valid_count, 55 * 77);
  const HeightMap wrapped = alignedTo(surface, surface, pose, Beyond::kPeriodic);
  EXPECT_EQ(invalidFraction(wrapped), 0.0);
  EXPECT_NEAR(wrapped.height(57, 1), surface.height(2, 78), 1e-22);
}

TEST(Alignment, aQuarterTurnTakesXToY) {
  const HeightMap surface = rough(61, 61);
  SurfacePose pose;
  pose.rotation = 0.5 * kPi;
  const HeightMap turned = alignedTo(surface, surface, pose);
  // What lay 10 columns towards +x of the middle now lies 10 rows towards +y.
  EXPECT_NEAR(turned.height(40, 30), surface.height(30, 40), 1e-20);
  EXPECT_NEAR(turned.height(30, 40), surface.height(20, 30), 1e-20);
  EXPECT_EQ(invalidFraction(turned), 0.0);
}

TEST(Alignment, paraboloidsComeBackOffGridTurnedAndOnAnotherPitch) {
  // Cubic convolution gives quadratics back exactly.
  const HeightMap scan = analytic::flat(40, 50, 7e-9, 9e-9);
  const HeightMap counter = analytic::paraboloid(201, 161, 4e-9, 3e-9, 1e-6, 30e-9, -20e-9);
  SurfacePose pose;
  pose.rotation = 0.4;
  pose.offset_x = 11e-9;
  pose.offset_y = -17e-9;
  const HeightMap found = alignedTo(scan, counter, pose);
  // its middle (30, -20) nm in the counter-surface's frame, in the scan's:
  const double x = 30e-9 * std::cos(0.4) + 20e-9 * std::sin(0.4) + 11e-9;
  const double y = 30e-9 * std::sin(0.4) - 20e-9 * std::cos(0.4) - 17e-9;
  const HeightMap expected = analytic::paraboloid(40, 50, 7e-9, 9e-9, 1e-6, x, y);
  EXPECT_GT(heightStatistics(found).valid_count, 1500);
  EXPECT_LT(largestDifference(found.heights(), expected.heights()),
            1e-11);  // linear within a pixel of the border
  EXPECT_NEAR(found.height(20, 25), expected.height(20, 25), 1e-21);
  EXPECT_EQ(found.pitchX(), 7e-9);
}

TEST(Alignment, thereAndBackIsTheSameSurface) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 160;
  options.correlation_length_x = options.correlation_length_y = 150e-9;
  const HeightMap surface = gaussianSurface(options);
  SurfacePose there;
  there.rotation = 0.3;
  SurfacePose back;
  back.rotation = -0.3;
  const HeightMap found = alignedTo(surface, alignedTo(surface, surface, there), back);
  EXPECT_LT(largestDifference(found.heights()(cv::Rect(50, 50, 60, 60)),
                              surface.heights()(cv::Rect(50, 50, 60, 60))),
            0.01 * options.rms_height);
}

TEST(Alignment, tiltLiftsTheSideOfLargerColumnsAndRows) {
  const HeightMap scan = analytic::flat(20, 31, 5e-9, 8e-9);
  SurfacePose pose;
  pose.tilt_x = 0.02;
  pose.tilt_y = -0.01;
  const HeightMap tilted = alignedTo(scan, scan, pose);
  const HeightMap expected =
      analytic::tiltedPlane(20, 31, 5e-9, 8e-9, std::tan(0.02), -std::tan(0.01));
  EXPECT_LT(largestDifference(tilted.heights(), expected.heights()), 1e-22);
  EXPECT_LT(largestDifference(tiltedFlat(scan, 0.02, -0.01).heights(), expected.heights()), 1e-22);
  EXPECT_GT(tilted.height(0, 30), tilted.height(0, 0));
}

TEST(Alignment, holesStayHolesOfTheirSize) {
  const HeightMap plane = analytic::tiltedPlane(40, 40, 5e-9, 5e-9, 0.1, 0.2);
  const HeightMap holed = analytic::withInvalidPixel(plane, 20, 20);
  SurfacePose pose;
  pose.offset_x = 0.3 * 5e-9;
  const HeightMap found = alignedTo(plane, holed, pose, Beyond::kInvalid);
  EXPECT_TRUE(std::isnan(found.height(20, 20)));
  EXPECT_FALSE(std::isnan(found.height(20, 21)));
  EXPECT_LT(largestDifference(found.heights()(cv::Rect(2, 2, 36, 36)),
                              alignedTo(plane, plane, pose).heights()(cv::Rect(2, 2, 36, 36))),
            0.5 * 5e-9 * 0.1);  // half a pixel of the slope
}

TEST(Alignment, refusesSurfacesThatDoNotMeetAndPosesThatAreNone) {
  const HeightMap surface = analytic::flat(10, 10, 1e-9, 1e-9);
  SurfacePose pose;
  pose.offset_x = 1e-6;
  EXPECT_THROW(alignedTo(surface, surface, pose), SurfaceError);
  pose.offset_x = std::nan("");
  EXPECT_THROW(alignedTo(surface, surface, pose), OptionsError);
  EXPECT_THROW(tiltedFlat(surface, 1.6, 0.0), OptionsError);
}

TEST(Alignment, RefusesPosesBeyondAnyInstrument) {
  const HeightMap surface(cv::Mat::zeros(8, 8, CV_64FC1), 1e-9, 1e-9);
  for (const double offset : {1e300, -1e300, 1e18}) {
    SurfacePose pose;
    pose.offset_x = offset;
    EXPECT_THROW(alignedTo(surface, surface, pose, Beyond::kPeriodic), OptionsError) << offset;
  }
  // In range, and still more pixels away than an integer counts: nothing lies there.
  const HeightMap fine(cv::Mat::zeros(8, 8, CV_64FC1), 1e-15, 1e-15);
  SurfacePose pose;
  pose.offset_x = 1000.0;
  EXPECT_THROW(alignedTo(fine, fine, pose, Beyond::kPeriodic), SurfaceError);
}

}  // namespace
}  // namespace mems_stiction
