/// From points to maps: orders of axes, holes, uneven and tilted points.

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "ros/source/cloud_cases.hpp"
#include "source/cloud_grid.hpp"
#include "source/cloud_points.hpp"

namespace mems_stiction {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void expectMap(const CloudMap& map, const cv::Mat& expected, double tolerance) {
  ASSERT_EQ(map.surface.heights().size(), expected.size());
  EXPECT_NEAR(map.surface.pitchX(), clouds::kPitchX, 1e-6 * clouds::kPitchX);
  EXPECT_NEAR(map.surface.pitchY(), clouds::kPitchY, 1e-6 * clouds::kPitchY);
  EXPECT_LE(cv::norm(map.surface.heights(), expected, cv::NORM_INF), tolerance);
}

TEST(CloudGrid, EveryOrderOfTheAxesGivesOneMap) {
  for (int order = 0; order < 8; ++order) {
    SCOPED_TRACE(order);
    const cv::Mat points =
        clouds::orderedPoints((order & 1) != 0, (order & 2) != 0, (order & 4) != 0);
    const CloudMap map = mapOfPoints(points, {});
    expectMap(map, clouds::expectedMap(), 0.0);
    EXPECT_TRUE(map.notes.empty());
  }
}

TEST(CloudGrid, HeightsAlongMinusZTurnTheSurfaceOverAsWhoeverLooksFromThereSeesIt) {
  // A sensor above the part, whose z points down, and y too, since it was turned over about x.
  cv::Mat points = clouds::orderedPoints(false, false, false);
  cv::multiply(points, cv::Scalar(1.0, -1.0, -1.0), points);
  CloudOptions options;
  options.is_up_negative = true;
  expectMap(mapOfPoints(points, options), clouds::expectedMap(), 0.0);
  // The same with a left-handed sensor, whose y does not.
  cv::multiply(points, cv::Scalar(1.0, -1.0, 1.0), points);
  options.mirror = Mirror::kNone;
  expectMap(mapOfPoints(points, options), clouds::expectedMap(), 0.0);
}

TEST(CloudGrid, AMirroredAxisIsTurnedBackIfStated) {
  cv::Mat points = clouds::orderedPoints(false, false, false);
  cv::multiply(points, cv::Scalar(-1.0, 1.0, 1.0), points);
  CloudOptions options;
  options.mirror = Mirror::kX;
  expectMap(mapOfPoints(points, options), clouds::expectedMap(), 0.0);
}

TEST(CloudGrid, HolesOfEveryKindAreNotMeasured) {
  cv::Mat points = clouds::orderedPoints(false, false, false);
  const double infinity = std::numeric_limits<double>::infinity();
  points.at<cv::Vec3d>(2, 3)[2] = kNan;
  points.at<cv::Vec3d>(2, 4)[2] = infinity;
  points.at<cv::Vec3d>(2, 5)[2] = -infinity;
  points.at<cv::Vec3d>(2, 6)[2] = -1.79769e+308;
  points.at<cv::Vec3d>(2, 7)[2] = 1e30;
  points.at<cv::Vec3d>(2, 8)[0] = kNan;
  points.at<cv::Vec3d>(2, 9) = {kNan, kNan, kNan};
  points.at<cv::Vec3d>(2, 10)[2] = -0.5;  // a sentinel that is stated
  CloudOptions options;
  options.invalid_below = -0.1;
  dropUnmeasured(points, options);
  const cv::Mat heights = mapOfPoints(points, options).surface.heights();
  const cv::Mat expected = clouds::expectedMap();
  for (int row = 0; row < clouds::kRows; ++row) {
    for (int col = 0; col < clouds::kCols; ++col) {
      const bool is_hole = row == 2 && col >= 3 && col <= 10;
      EXPECT_EQ(std::isnan(heights.at<double>(row, col)), is_hole) << row << " " << col;
      if (!is_hole) {
        EXPECT_EQ(heights.at<double>(row, col), expected.at<double>(row, col));
      }
    }
  }
}

TEST(CloudGrid, ATiltedPlaneStaysExactWhateverTheCells) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0.0, 1e-3);
  cv::Mat points(1, 20000, CV_64FC3);
  for (int i = 0; i < points.cols; ++i) {
    const double x = place(random), y = place(random);
    points.at<cv::Vec3d>(0, i) = {x, y, 0.3 * x - 0.2 * y + 4e-3};
  }
  CloudOptions options;
  options.pitch_x = 20e-6;
  options.pitch_y = 25e-6;
  const CloudMap map = mapOfPoints(points, options);
  const cv::Mat& heights = map.surface.heights();
  // A plane has the same step from cell to cell everywhere, to round-off of the sums.
  for (int row = 0; row + 1 < heights.rows; ++row) {
    for (int col = 0; col + 1 < heights.cols; ++col) {
      const double here = heights.at<double>(row, col);
      if (std::isnan(here)) continue;
      const double right = heights.at<double>(row, col + 1),
                   below = heights.at<double>(row + 1, col);
      if (!std::isnan(right)) {
        EXPECT_NEAR(right - here, 0.3 * 20e-6, 1e-14);
      }
      if (!std::isnan(below)) {
        EXPECT_NEAR(below - here, 0.2 * 25e-6, 1e-14);
      }
    }
  }
  ASSERT_EQ(map.notes.size(), 1u);
  EXPECT_NE(map.notes.front().find("points in the mean"), std::string::npos);
}

TEST(CloudGrid, UnevenPointsComeOnAGridThatTheyFill) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  cv::Mat points(60, 80, CV_64FC3);
  for (int row = 0; row < points.rows; ++row) {
    for (int col = 0; col < points.cols; ++col) {
      const double x = (col + shift(random)) * clouds::kPitchX,
                   y = -(row + shift(random)) * clouds::kPitchY;
      points.at<cv::Vec3d>(row, col) = {x, y, clouds::surfaceAt(x, y)};
    }
  }
  const CloudMap map = mapOfPoints(points, {});
  const cv::Mat& heights = map.surface.heights();
  int missing = 0;
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col)
      missing += std::isnan(heights.at<double>(row, col)) ? 1 : 0;
  }
  EXPECT_LT(missing, 0.02 * heights.total());
  EXPECT_GT(map.surface.pitchX(), clouds::kPitchX);
  EXPECT_LT(map.surface.pitchX(), 2.0 * clouds::kPitchX);
}

TEST(CloudGrid, ALatticeThatIsTurnedLeavesNoCellWithin) {
  constexpr int kSide = 60;
  constexpr double kStep = 1e-5;
  for (const double degrees : {10.0, 30.0, 45.0, 80.0}) {
    SCOPED_TRACE(degrees);
    const double c = std::cos(degrees * CV_PI / 180.0);
    const double s = std::sin(degrees * CV_PI / 180.0);
    cv::Mat points(kSide, kSide, CV_64FC3);
    for (int row = 0; row < kSide; ++row) {
      for (int col = 0; col < kSide; ++col)
        points.at<cv::Vec3d>(row, col) = {kStep * (c * col - s * row), kStep * (s * col + c * row),
                                          1e-9};
    }
    const HeightMap map = mapOfPoints(points, {}).surface;
    EXPECT_LE(map.pitchX(), 1.4143 * kStep);
    const cv::Rect middle(map.cols() / 2 - 8, map.rows() / 2 - 8, 16, 16);
    EXPECT_TRUE(cv::checkRange(map.heights()(middle)));
  }
}

TEST(CloudGrid, APitchThatIsStatedIsThatOfTheMap) {
  CloudOptions options;
  options.pitch_x = options.pitch_y = 70e-6;
  const CloudMap map = mapOfPoints(clouds::orderedPoints(true, true, false), options);
  EXPECT_EQ(map.surface.pitchX(), 70e-6);
  EXPECT_EQ(map.surface.rows(), 6);  // 11 x 30 um from the first point to the last
  EXPECT_EQ(map.surface.cols(), 6);  // 16 x 20 um
}

TEST(CloudGrid, RefusesWhatMakesNoMap) {
  cv::Mat points = clouds::orderedPoints(false, false, false);
  const cv::Mat list = points.reshape(0, 1).clone();
  EXPECT_THROW(mapOfPoints(list, {}), SurfaceError);  // no order, no pitch
  CloudOptions fine;
  fine.pitch_x = fine.pitch_y = 1e-12;
  EXPECT_THROW(mapOfPoints(list, fine), SurfaceError);  // more cells than memory
  points.setTo(cv::Scalar(0.0, 0.0, kNan));
  EXPECT_THROW(mapOfPoints(points, {}), SurfaceError);
  points.setTo(cv::Scalar(1.0, 1.0, 1.0));
  EXPECT_THROW(mapOfPoints(points, {}), SurfaceError);
}

TEST(CloudGrid, PointsGoIntoAnotherFrame) {
  geometry_msgs::Transform transform;  // a quarter of a turn about z, and up
  transform.rotation.z = transform.rotation.w = std::sqrt(0.5);
  transform.translation.z = 2.0;
  cv::Mat points(1, 1, CV_64FC3, cv::Scalar(3.0, 5.0, 7.0));
  transformPoints(transform, points);
  const cv::Vec3d moved = points.at<cv::Vec3d>(0, 0);
  EXPECT_NEAR(moved[0], -5.0, 1e-12);
  EXPECT_NEAR(moved[1], 3.0, 1e-12);
  EXPECT_NEAR(moved[2], 9.0, 1e-12);
}

}  // namespace
}  // namespace mems_stiction
