#include "preprocess/level.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

Plane planeOf(const HeightMap& surface) {
  WorkingSurface work(surface);
  return leastSquaresPlane(work);
}

constexpr double kPitchX = 13e-9;
constexpr double kPitchY = 31e-9;
constexpr double kStageOffset = 0.076;  // an interferometer's stage [m]
// doubles near 76 mm are 1.4e-17 m apart
constexpr double kSpacingUnderOffset = 1.4e-17;

double largestDifference(const HeightMap& first, const HeightMap& second) {
  return cv::norm(first.heights(), second.heights(), cv::NORM_INF);
}

double largestHeight(const HeightMap& surface) { return cv::norm(surface.heights(), cv::NORM_INF); }

TEST(LeastSquaresPlane, findsSlopesAndHeightOfAPlane) {
  const Plane plane = planeOf(analytic::tiltedPlane(23, 40, kPitchX, kPitchY, 0.012, -0.3, 5e-6));
  EXPECT_NEAR(plane.slope_x, 0.012,
              1e-12);  // round-off of sums over 920 pixels of heights up to 5 um
  EXPECT_NEAR(plane.slope_y, -0.3, 1e-12);
  EXPECT_NEAR(plane.mean_height, 5e-6, 1e-18);
  EXPECT_NEAR(plane.centre_x, 0.5 * 39 * kPitchX, 1e-20);
  EXPECT_NEAR(plane.height(0.0, 0.0), 5e-6 - 0.012 * 19.5 * kPitchX + 0.3 * 11.0 * kPitchY, 1e-18);
}

TEST(Levelled, leavesNothingOfAPlane) {
  const HeightMap flat =
      levelled(analytic::tiltedPlane(23, 40, kPitchX, kPitchY, 0.012, -0.3, 5e-6));
  EXPECT_EQ(flat.heights().type(), CV_64FC1);
  EXPECT_EQ(flat.pitchX(), kPitchX);
  EXPECT_EQ(flat.pitchY(), kPitchY);
  EXPECT_LT(largestHeight(flat), 1e-19);  // round-off of 5 um: 1e-21 a step
}

TEST(Levelled, givesBackARoughnessThatHasNoTiltOfItsOwn) {
  // cosine-like along y and symmetrical caps have no tilt: a centred paraboloid less its mean is
  // already level
  const HeightMap cap = analytic::paraboloid(41, 64, kPitchX, kPitchY, 2e-6);
  const HeightMap tilted =
      analytic::sum(cap, analytic::tiltedPlane(41, 64, kPitchX, kPitchY, 0.05, -0.02, 3e-7));
  EXPECT_LT(largestDifference(levelled(tilted), levelled(cap)), 1e-20);
  EXPECT_NEAR(planeOf(cap).slope_x, 0.0, 1e-13);
}

TEST(Levelled, keepsNanometresUnderAStageOffset) {
  const HeightMap cap = analytic::paraboloid(41, 64, kPitchX, kPitchY, 2e-6);
  const HeightMap tilted = analytic::sum(
      cap, analytic::tiltedPlane(41, 64, kPitchX, kPitchY, 0.05, -0.02, kStageOffset));
  // each height is rounded once under the offset, and the fit averages those errors
  EXPECT_LT(largestDifference(levelled(tilted), levelled(cap)), 2.0 * kSpacingUnderOffset);
}

TEST(Levelled, isTheSameWhenDoneTwice) {
  const HeightMap rough = analytic::sine(30, 50, kPitchX, kPitchY, 2e-9, 1, 2);
  const HeightMap once = levelled(rough);
  EXPECT_LT(largestDifference(levelled(once), once), 1e-22);  // round-off of 2 nm
  const Plane left = planeOf(once);
  EXPECT_NEAR(left.slope_x, 0.0, 1e-14);
  EXPECT_NEAR(left.slope_y, 0.0, 1e-14);
  EXPECT_NEAR(left.mean_height, 0.0, 1e-22);
}

TEST(Levelled, isTheLeastOfAllPlanes) {
  const HeightMap rough = analytic::sine(30, 50, kPitchX, kPitchY, 2e-9, 1, 2);
  const double least = cv::norm(levelled(rough).heights());
  for (const double slope : {-1e-5, 1e-5}) {
    const HeightMap along_x = analytic::tiltedPlane(30, 50, kPitchX, kPitchY, slope, 0.0);
    const HeightMap along_y = analytic::tiltedPlane(30, 50, kPitchX, kPitchY, 0.0, slope);
    EXPECT_GT(cv::norm(analytic::sum(levelled(rough), along_x).heights()), least);
    EXPECT_GT(cv::norm(analytic::sum(levelled(rough), along_y).heights()), least);
  }
}

TEST(Levelled, takesSinglePrecisionAndSubtractsInDouble) {
  const HeightMap plane = analytic::tiltedPlane(20, 30, kPitchX, kPitchY, 0.01, 0.02, 1e-3);
  const HeightMap flat = levelled(analytic::asSingle(plane));
  EXPECT_EQ(flat.heights().type(), CV_64FC1);
  // float32 near 1 mm: spacing 0.116 nm, half of it in each height, and as much again that the fit
  // may pick up
  EXPECT_LT(largestHeight(flat), 0.116e-9);
  EXPECT_GT(largestHeight(flat), 0.0);
}

TEST(Levelled, fitsValidPixelsOnlyAndKeepsInvalidOnesInvalid) {
  HeightMap plane = analytic::tiltedPlane(20, 30, kPitchX, kPitchY, 0.01, 0.02);
  cv::Mat heights = plane.heights().clone();
  heights.at<double>(0, 0) = std::numeric_limits<double>::quiet_NaN();
  heights.at<double>(7, 3) = std::numeric_limits<double>::infinity();
  const HeightMap flat = levelled(HeightMap(heights, kPitchX, kPitchY));
  EXPECT_TRUE(std::isnan(flat.height(0, 0)));
  EXPECT_TRUE(std::isnan(flat.height(7, 3)));
  EXPECT_LT(heightStatistics(flat).rms_height, 1e-21);
  EXPECT_EQ(heightStatistics(flat).valid_count, 598);
  EXPECT_TRUE(std::isinf(heights.at<double>(7, 3)));  // the input is left alone
}

TEST(Levelled, takesTheSlopeAlongASingleRowOrColumn) {
  const Plane row =
      planeOf(analytic::tiltedPlane(1, 30, kPitchX, kPitchY, 0.01, 0.7, kStageOffset));
  EXPECT_NEAR(row.slope_x, 0.01, 30.0 * kSpacingUnderOffset / kPitchX);
  EXPECT_EQ(row.slope_y, 0.0);
  const Plane column = planeOf(analytic::tiltedPlane(30, 1, kPitchX, kPitchY, 0.7, 0.01));
  EXPECT_EQ(column.slope_x, 0.0);
  EXPECT_NEAR(column.slope_y, 0.01, 1e-14);
}

TEST(Levelled, takesTheSlopeAlongALineOfValidPixels) {
  const double invalid = std::numeric_limits<double>::quiet_NaN();
  cv::Mat heights(5, 5, CV_64FC1, cv::Scalar(invalid));
  for (int index = 0; index < 5; ++index) heights.at<double>(index, index) = 1e-9 * index;
  const Plane plane = planeOf(HeightMap(heights, kPitchX, kPitchY));
  // along the diagonal (px, py): s = 1 nm/(px^2 + py^2) (px, py), nothing across
  const double per_square = 1e-9 / (kPitchX * kPitchX + kPitchY * kPitchY);
  EXPECT_NEAR(plane.slope_x, per_square * kPitchX, 1e-12);
  EXPECT_NEAR(plane.slope_y, per_square * kPitchY, 1e-12);
}

TEST(Levelled, handlesOneAndTwoPixels) {
  const cv::Mat one(1, 1, CV_64FC1, cv::Scalar(4e-9));
  EXPECT_EQ(levelled(HeightMap(one, kPitchX, kPitchY)).height(0, 0), 0.0);
  const cv::Mat two = (cv::Mat_<double>(2, 1) << 1e-9, 3e-9);
  EXPECT_LT(largestHeight(levelled(HeightMap(two, kPitchX, kPitchY))), 1e-23);  // round-off of 1 nm
}

TEST(Levelled, fitsTwoLongRows) {
  // the worst-conditioned frame that still shows both slopes
  const Plane plane = planeOf(analytic::tiltedPlane(2, 40000, kPitchX, kPitchY, 1e-3, 0.05));
  EXPECT_NEAR(plane.slope_x, 1e-3, 1e-12);
  EXPECT_NEAR(plane.slope_y, 0.05,
              1e-9);  // heights of 0.26 um rounded to 5e-23 m, over 80000 pixels of one pitch
}

TEST(Levelled, refusesASurfaceWithoutAValidPixel) {
  const cv::Mat heights(3, 4, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_THROW(levelled(HeightMap(heights, kPitchX, kPitchY)), SurfaceError);
}

}  // namespace
}  // namespace mems_stiction
