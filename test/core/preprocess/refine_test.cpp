#include "preprocess/refine.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitchX = 6e-9;
constexpr double kPitchY = 10e-9;

RefineOptions by(int factor, Interpolation interpolation = Interpolation::kCubic) {
  RefineOptions options;
  options.factor = factor;
  options.interpolation = interpolation;
  return options;
}

double largestDifference(const cv::Mat& first, const cv::Mat& second) {
  double largest = 0.0;
  cv::minMaxLoc(cv::abs(first - second), nullptr, &largest);
  return largest;
}

TEST(Refine, dividesThePitchAndKeepsTheArea) {
  const HeightMap fine = refined(analytic::flat(20, 31, kPitchX, kPitchY, 1e-3), by(3));
  EXPECT_EQ(fine.rows(), 60);
  EXPECT_EQ(fine.cols(), 93);
  EXPECT_DOUBLE_EQ(fine.pitchX(), 2e-9);
  EXPECT_DOUBLE_EQ(fine.rows() * fine.cols() * fine.cellArea(), 20 * 31 * kPitchX * kPitchY);
  EXPECT_NEAR(heightStatistics(fine).max, 1e-3, 1e-18);
}

TEST(Refine, factorOneChangesNothing) {
  const HeightMap surface = analytic::sine(20, 30, kPitchX, kPitchY, 1e-9, 2, 3);
  EXPECT_EQ(largestDifference(refined(surface, by(1)).heights(), surface.heights()), 0.0);
}

TEST(Refine, keepsTheMeasuredHeightsWhereTheyAre) {
  const HeightMap surface = analytic::sine(20, 30, kPitchX, kPitchY, 1e-9, 2, 3);
  for (const Interpolation interpolation : {Interpolation::kCubic, Interpolation::kLanczos}) {
    const HeightMap fine =
        refined(surface, by(3, interpolation));  // odd: every pixel has a middle one
    EXPECT_NEAR(fine.height(3 * 7 + 1, 3 * 11 + 1), surface.height(7, 11), 1e-22);
  }
}

TEST(Refine, givesPlanesAndParaboloidsBack) {
  const HeightMap plane = analytic::tiltedPlane(20, 30, kPitchX, kPitchY, 0.1, -0.3);
  const HeightMap fine_plane = analytic::tiltedPlane(80, 120, kPitchX / 4, kPitchY / 4, 0.1, -0.3);
  EXPECT_LT(largestDifference(refined(plane, by(4)).heights(), fine_plane.heights()), 1e-21);

  const HeightMap dome = analytic::paraboloid(20, 30, kPitchX, kPitchY, 300e-9);
  const HeightMap fine_dome = analytic::paraboloid(80, 120, kPitchX / 4, kPitchY / 4, 300e-9);
  const cv::Rect inside(
      8, 8, 104, 64);  // two original pixels from the border the weights stay within the frame
  EXPECT_LT(largestDifference(refined(dome, by(4)).heights()(inside), fine_dome.heights()(inside)),
            1e-21);
}

TEST(Refine, drawsASineOfEightPixels) {
  // Keys' kernel is of third order in pitch/wavelength: some per cent at eight pixels per wave.
  const int factor = 4;
  const HeightMap fine = refined(analytic::sine(8, 64, kPitchX, kPitchY, 1e-9, 8), by(factor));
  double largest = 0.0;
  for (int col = 3 * factor; col < 61 * factor; ++col) {
    const double position = (col + 0.5) / factor - 0.5;
    largest = std::max(
        largest, std::fabs(fine.height(16, col) - 1e-9 * std::sin(2.0 * kPi * position / 8.0)));
  }
  EXPECT_LT(largest, 0.03e-9);
}

TEST(Refine, invalidPixelsStayInvalidAndDoNotSpread) {
  const HeightMap plane = analytic::tiltedPlane(20, 30, kPitchX, kPitchY, 0.1, -0.3);
  HeightMap holed = analytic::withInvalidPixel(plane, 9, 9);
  holed = analytic::withInvalidPixel(analytic::withInvalidPixel(holed, 0, 0), 9, 10);
  for (const Interpolation interpolation : {Interpolation::kCubic, Interpolation::kLanczos}) {
    const HeightMap fine = refined(holed, by(2, interpolation));
    EXPECT_EQ(heightStatistics(fine).valid_count, 4 * (600 - 3));
    EXPECT_TRUE(std::isnan(fine.height(19, 21)));
    cv::Mat error = fine.heights() - refined(plane, by(2, interpolation)).heights();
    error.setTo(0.0, ~validMask(error));
    EXPECT_LT(largestDifference(error, cv::Mat::zeros(error.size(), CV_64FC1)),
              1e-15);  // the plate's equations
  }
}

TEST(Refine, worksOnSingleRowsAndRefusesWhatDoesNotFit) {
  EXPECT_EQ(refined(analytic::sine(1, 40, kPitchX, kPitchY, 1e-9, 2), by(2)).rows(), 2);
  EXPECT_EQ(
      refined(analytic::flat(2, 1, kPitchX, kPitchY, 1e-9), by(2, Interpolation::kLanczos)).cols(),
      2);
  EXPECT_THROW(refined(analytic::flat(2000, 2000, kPitchX, kPitchY), by(16)), SurfaceError);
}

}  // namespace
}  // namespace mems_stiction
