#include "roughness/filled_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/holed_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

HeightMap tiltedPlane(int rows, int cols) {
  cv::Mat heights(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col)
      heights.at<double>(row, col) = 1e-6 + 2e-9 * col - 3e-9 * row;
  }
  return {heights, 10e-9, 10e-9};
}

TEST(FilledSurface, SharesThePixelsOfASurfaceWithoutHoles) {
  const HeightMap surface = tiltedPlane(20, 30);
  const FilledSurface filled = filledSurface(surface);
  EXPECT_EQ(filled.surface.heights().data, surface.heights().data);
  EXPECT_TRUE(filled.distances.empty());
  EXPECT_EQ(filledSentence(surface), "");
}

TEST(FilledSurface, APlaneComesBackWhateverTheHoles) {
  const HeightMap plane = tiltedPlane(120, 150);
  const HeightMap holed = withScatteredHoles(withRoundHoles(plane, 0.2, 1), 0.1, 2);
  const FilledSurface filled = filledSurface(holed);
  ASSERT_EQ(filled.surface.heights().size(), plane.heights().size());
  EXPECT_LT(cv::norm(filled.surface.heights(), plane.heights(), cv::NORM_INF), 1e-15);
  EXPECT_EQ(cv::countNonZero(filled.distances), cv::countNonZero(~validMask(holed.heights())));
}

/// A stopped scan, or a region without its surroundings: what was never measured is not made up.
TEST(FilledSurface, LinesWithoutAMeasuredPixelAreCutOff) {
  cv::Mat heights = tiltedPlane(40, 50).heights().clone();
  heights.rowRange(30, 40).setTo(kMissing);
  heights.colRange(0, 7).setTo(kMissing);
  const FilledSurface filled = filledSurface(HeightMap(heights, 10e-9, 10e-9));
  EXPECT_EQ(filled.surface.heights().size(), cv::Size(43, 30));
  EXPECT_TRUE(filled.distances.empty());
  EXPECT_EQ(filled.surface.height(0, 0), heights.at<double>(0, 7));
}

/// A plate that went on freely would leave the frame by far.
TEST(FilledSurface, WideHolesStayAmongTheHeightsAroundThem) {
  cv::Mat heights(200, 200, CV_64FC1);
  cv::RNG random(3);
  random.fill(heights, cv::RNG::NORMAL, 0.0, 1e-9);
  heights(cv::Rect(90, 90, 110, 110)).setTo(kMissing);
  const FilledSurface filled = filledSurface(HeightMap(heights, 10e-9, 10e-9));
  double lowest = 0.0;
  double highest = 0.0;
  cv::minMaxLoc(filled.surface.heights()(cv::Rect(95, 95, 105, 105)), &lowest, &highest);
  EXPECT_GT(lowest, -5e-9);
  EXPECT_LT(highest, 5e-9);
}

TEST(FilledSurface, NeedsOnePixel) {
  cv::Mat heights(30, 30, CV_64FC1, cv::Scalar(kMissing));
  EXPECT_THROW(filledSurface(HeightMap(heights, 10e-9, 10e-9)), SurfaceError);
  heights.at<double>(4, 5) = 2e-9;
  const FilledSurface filled = filledSurface(HeightMap(heights, 10e-9, 10e-9));
  EXPECT_EQ(filled.surface.heights().size(), cv::Size(1, 1));
}

TEST(FilledSurface, SaysWhatIsMissing) {
  const std::string one = filledSentence(analytic::withInvalidPixel(tiltedPlane(20, 50), 3, 4));
  EXPECT_NE(one.find("1 of 1000 pixels are missing (0.1 %)"), std::string::npos) << one;
  EXPECT_EQ(one.find("so much is missing"), std::string::npos) << one;
  const std::string many = filledSentence(withScatteredHoles(tiltedPlane(100, 100), 0.3, 1));
  EXPECT_NE(many.find("so much is missing"), std::string::npos) << many;
}

TEST(KnownShare, CountsThePixelsThatKnowAWave) {
  cv::Mat distances = cv::Mat::zeros(10, 10, CV_32FC1);
  distances.at<float>(2, 2) = 1.0F;
  distances.at<float>(7, 7) = 4.0F;
  const std::vector<double> even(10, 1.0);
  const KnownShare known(distances, even, even);
  EXPECT_DOUBLE_EQ(known.of(3.0), 0.98);
  EXPECT_DOUBLE_EQ(known.of(1.0), 0.99);
  EXPECT_DOUBLE_EQ(known.of(0.1), 1.0);
  EXPECT_EQ(KnownShare({}, even, even).of(3.0), 1.0);
}

}  // namespace
}  // namespace mems_stiction
