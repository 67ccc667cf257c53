#include "mems_stiction/roughness/areal_parameters.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitchX = 11e-9;
constexpr double kPitchY = 27e-9;

void expectRelative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::fabs(expected));
}

TEST(ArealParameters, ofASineReachAsFarUpAsDown) {
  const double amplitude = 4.2e-9;
  const ArealParameters found =
      arealParameters(analytic::sine(37, 240, kPitchX, kPitchY, amplitude, 5));
  // 48 points a period, a multiple of 4: a sample on each crest and in each trough
  expectRelative(found.sp, amplitude, 1e-12);
  expectRelative(found.sv, amplitude, 1e-12);
}

TEST(ArealParameters, gradientOfASineIsThatOfCentralDifferences) {
  const double amplitude = 4.2e-9;
  const int cols = 240;
  const int periods = 5;
  const double phase_step = 2.0 * kPi * periods / cols;
  const ArealParameters found =
      arealParameters(analytic::sine(37, cols, kPitchX, kPitchY, amplitude, periods));
  // central differences of a sine are A sin(step)/pitch cos(x); two of 240 columns, at phase 0,
  // have no neighbours and their cos^2 is 1 where the mean is 1/2: (120 - 2)/(240 - 2)
  const double central = amplitude * std::sin(phase_step) / kPitchX;
  const double cos_first = 1.0;
  const double cos_last = std::cos(phase_step);
  const double mean_square = (0.5 * cols - cos_first - cos_last * cos_last) / (cols - 2);
  expectRelative(found.sdq, central * std::sqrt(mean_square), 1e-10);
  // and the derivative itself, A k/sqrt(2), to the order of the differences, (step^2)/6 = 0.3 %,
  // and the two columns
  expectRelative(found.sdq, amplitude * phase_step / kPitchX / std::sqrt(2.0), 0.01);
}

TEST(ArealParameters, heightsOfATiltedPlaneHaveTheVarianceOfEquidistantPoints) {
  const double slope_x = 0.13;
  const double slope_y = -0.04;
  const ArealParameters found =
      arealParameters(analytic::tiltedPlane(31, 18, kPitchX, kPitchY, slope_x, slope_y));
  // n equidistant points have the variance (n^2 - 1)/12 of their step
  const double variance_x = slope_x * slope_x * kPitchX * kPitchX * (18.0 * 18.0 - 1.0) / 12.0;
  const double variance_y = slope_y * slope_y * kPitchY * kPitchY * (31.0 * 31.0 - 1.0) / 12.0;
  expectRelative(found.sq, std::sqrt(variance_x + variance_y), 1e-12);
  EXPECT_NEAR(found.ssk, 0.0, 1e-12);
}

TEST(ArealParameters, ofAParaboloidAreItsClosedForms) {
  const double radius = 2e-6;
  const int rows = 41;
  const int cols = 64;
  const ArealParameters found =
      arealParameters(analytic::paraboloid(rows, cols, kPitchX, kPitchY, radius));
  // central differences of a parabola are exact: slopes x/R and y/R on the inner points
  const double mean_x2 = kPitchX * kPitchX * ((cols - 2.0) * (cols - 2.0) - 1.0) / 12.0;
  const double mean_y2 = kPitchY * kPitchY * ((rows - 2.0) * (rows - 2.0) - 1.0) / 12.0;
  expectRelative(found.sdq, std::sqrt(mean_x2 + mean_y2) / radius, 1e-11);
  // n equidistant points of step h about 0: variance of x^2 is h^4 (n^2 - 1)(n^2 - 4)/180
  const double spread_x = std::pow(kPitchX, 4) * (cols * cols - 1.0) * (cols * cols - 4.0) / 180.0;
  const double spread_y = std::pow(kPitchY, 4) * (rows * rows - 1.0) * (rows * rows - 4.0) / 180.0;
  expectRelative(found.sq, std::sqrt(spread_x + spread_y) / (2.0 * radius), 1e-12);
  EXPECT_LT(found.ssk, 0.0);  // a cap has long tails downwards
  // highest: half a pitch off the middle in x, on it in y
  const double mean =
      -(kPitchX * kPitchX * (cols * cols - 1.0) + kPitchY * kPitchY * (rows * rows - 1.0)) / 12.0;
  expectRelative(found.sp, (-0.25 * kPitchX * kPitchX - mean) / (2.0 * radius), 1e-12);
}

/// Two heights, a share p of the upper: skewness (1 - 2 p)/sqrt(p (1 - p)), kurtosis 1/(p (1 - p))
/// - 3.
TEST(ArealParameters, ofTwoLevelsAreThoseOfABernoulliVariable) {
  cv::Mat1d heights(20, 30, 1e-9);
  heights.rowRange(0, 3) = 7e-9;
  const double share = 3.0 / 20.0;
  const double variance = share * (1.0 - share);
  const ArealParameters found = arealParameters(HeightMap(heights, kPitchX, kPitchY));
  expectRelative(found.sq, 6e-9 * std::sqrt(variance), 1e-12);
  expectRelative(found.sa, 2.0 * 6e-9 * variance, 1e-12);
  expectRelative(found.ssk, (1.0 - 2.0 * share) / std::sqrt(variance), 1e-12);
  expectRelative(found.sku, 1.0 / variance - 3.0, 1e-12);
}

TEST(ArealParameters, sdrIsHalfOfSdqSquaredForSmallSlopes) {
  const ArealParameters found =
      arealParameters(analytic::sine(40, 41, kPitchX, kPitchY, 2e-11, 3, 2));
  // next term: slope^2/4, slopes of 1e-3
  expectRelative(found.sdr, 0.5 * found.sdq * found.sdq, 1e-6);
}

TEST(ArealParameters, areTheSameUnderAStageOffset) {
  const HeightMap surface = analytic::sine(50, 60, kPitchX, kPitchY, 1e-9, 4, 3);
  const HeightMap offset = analytic::sum(surface, analytic::flat(50, 60, kPitchX, kPitchY, 0.076));
  const ArealParameters plain = arealParameters(surface);
  const ArealParameters found = arealParameters(offset);
  // doubles near 76 mm are 1.4e-17 m apart: 1.4e-8 of 1 nm
  expectRelative(found.sq, plain.sq, 1e-7);
  expectRelative(found.sa, plain.sa, 1e-7);
  expectRelative(found.sku, plain.sku, 1e-7);
  expectRelative(found.sdq, plain.sdq, 1e-7);
}

TEST(ArealParameters, scaleWithHeight) {
  const HeightMap surface = analytic::paraboloid(20, 31, kPitchX, kPitchY, 1e-6);
  cv::Mat tenfold = surface.heights() * 10.0;
  const ArealParameters plain = arealParameters(surface);
  const ArealParameters found = arealParameters(HeightMap(tenfold, kPitchX, kPitchY));
  expectRelative(found.sa, 10.0 * plain.sa, 1e-13);
  expectRelative(found.sq, 10.0 * plain.sq, 1e-13);
  expectRelative(found.sz, 10.0 * plain.sz, 1e-13);
  expectRelative(found.sdq, 10.0 * plain.sdq, 1e-13);
  expectRelative(found.ssk, plain.ssk, 1e-12);
  expectRelative(found.sku, plain.sku, 1e-12);
}

TEST(ArealParameters, ofSinglePrecisionAgreeToItsDigits) {
  const HeightMap surface = analytic::sine(40, 50, kPitchX, kPitchY, 3e-9, 4, 3);
  const ArealParameters wide = arealParameters(surface);
  const ArealParameters narrow = arealParameters(analytic::asSingle(surface));
  expectRelative(narrow.sq, wide.sq, 1e-7);  // 24 bits of height
  expectRelative(narrow.sku, wide.sku, 1e-7);
  expectRelative(narrow.sdq, wide.sdq, 1e-6);  // a difference of neighbours keeps fewer
}

TEST(ArealParameters, leaveInvalidPixelsOut) {
  const HeightMap plane = analytic::tiltedPlane(9, 12, kPitchX, kPitchY, 0.2, 0.1);
  const ArealParameters whole = arealParameters(plane);
  // a hole takes its own pixel and the gradients of its four neighbours; on a plane the others are
  // all the same
  const ArealParameters holed = arealParameters(analytic::withInvalidPixel(plane, 4, 5));
  expectRelative(holed.sdq, whole.sdq, 1e-12);
  EXPECT_TRUE(std::isfinite(holed.sku));

  cv::Mat heights = (cv::Mat_<double>(1, 4) << 1e-9, std::numeric_limits<double>::quiet_NaN(), 3e-9,
                     std::numeric_limits<double>::infinity());
  const ArealParameters two = arealParameters(HeightMap(heights, kPitchX, kPitchY));
  EXPECT_DOUBLE_EQ(two.sq, 1e-9);
  EXPECT_DOUBLE_EQ(two.sa, 1e-9);
  EXPECT_DOUBLE_EQ(two.sz, 2e-9);
  EXPECT_NEAR(two.sku, 1.0, 1e-14);
}

TEST(ArealParameters, ofAConstantSurfaceAreZero) {
  const ArealParameters found = arealParameters(analytic::flat(7, 5, kPitchX, kPitchY, 0.0123));
  for (const double value : {found.sa, found.sq, found.ssk, found.sku, found.sp, found.sv, found.sz,
                             found.sdq, found.sdr}) {
    EXPECT_EQ(value, 0.0);
  }
}

TEST(ArealParameters, haveNoGradientWithoutFourNeighbors) {
  const ArealParameters line = arealParameters(analytic::sine(1, 40, kPitchX, kPitchY, 1e-9, 2));
  EXPECT_GT(line.sq, 0.0);
  EXPECT_EQ(line.sdq, 0.0);
  EXPECT_EQ(line.sdr, 0.0);
}

TEST(ArealParameters, refuseASurfaceWithoutAValidPixel) {
  const cv::Mat heights(3, 4, CV_32FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_THROW(arealParameters(HeightMap(heights, kPitchX, kPitchY)), SurfaceError);
  EXPECT_THROW(arealParameters(HeightMap()), SurfaceError);
}

}  // namespace
}  // namespace mems_stiction
