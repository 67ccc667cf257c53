#include "preprocess/polynomial_level.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "preprocess/level.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

PolynomialSurface fitPolynomial(const HeightMap& surface, int degree, FitWeights weights) {
  WorkingSurface work(surface);
  return mems_stiction::fitPolynomial(work.heights, work.pitch_x, work.pitch_y, degree, weights,
                                      work.memory);
}

HeightMap without(const PolynomialSurface& polynomial, const HeightMap& surface) {
  WorkingSurface work(surface);
  subtract(polynomial, work);
  return work.surface();
}

HeightMap levelledBy(const HeightMap& surface, const LevelOptions& options) {
  PipelineOptions pipeline;
  pipeline.level = options;
  return cleanScan(surface, pipeline).surface;
}

constexpr double kPitchX = 7e-9;
constexpr double kPitchY = 11e-9;

/// Tilt, bow in both axes and twist, on the grid of `surface`.
HeightMap bent(const HeightMap& surface, double offset = 0.0) {
  cv::Mat heights = surface.asDouble().heights().clone();
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double u = 2.0 * col / heights.cols - 1.0;
      const double v = 2.0 * row / heights.rows - 1.0;
      heights.at<double>(row, col) +=
          offset + 40e-9 * u - 25e-9 * v + 12e-9 * u * u + 5e-9 * u * v - 9e-9 * v * v;
    }
  }
  return {heights, surface.pitchX(), surface.pitchY()};
}

double largestDifference(const HeightMap& first, const HeightMap& second) {
  double largest = 0.0;
  cv::minMaxLoc(cv::abs(first.heights() - second.heights()), nullptr, &largest);
  return largest;
}

GaussianSurfaceOptions rough() {
  GaussianSurfaceOptions options;
  options.rows = 200;
  options.cols = 310;
  options.pitch_x = kPitchX;
  options.pitch_y = kPitchY;
  options.rms_height = 2e-9;
  options.correlation_length_x = options.correlation_length_y = 40e-9;
  return options;
}

TEST(PolynomialLevel, takesAPolynomialOfDegreeTwoOffExactly) {
  const HeightMap surface = bent(analytic::flat(61, 84, kPitchX, kPitchY));
  for (const FitWeights weights : {FitWeights::kEqual, FitWeights::kRobust}) {
    const HeightMap flat = without(fitPolynomial(surface, 2, weights), surface);
    EXPECT_LT(heightStatistics(flat).rms_height, 1e-13 * 40e-9 * 100.0);  // round-off of some sums
  }
}

TEST(PolynomialLevel, keepsTheRoughnessUnderAStageOffset) {
  const HeightMap clean = gaussianSurface(rough());
  const HeightMap near = without(fitPolynomial(bent(clean), 2, FitWeights::kEqual), bent(clean));
  const HeightMap far =
      without(fitPolynomial(bent(clean, 0.01), 2, FitWeights::kEqual), bent(clean, 0.01));
  EXPECT_LT(largestDifference(near, far), 5e-18);  // a double at 0.01 m is spaced by 1.7e-18 m
}

TEST(PolynomialLevel, degreeOneIsTheLeastSquaresPlane) {
  const HeightMap surface = bent(gaussianSurface(rough()));
  const HeightMap ours = without(fitPolynomial(surface, 1, FitWeights::kEqual), surface);
  EXPECT_LT(largestDifference(ours, levelled(surface)), 1e-20);  // round-off of 40 nm
}

TEST(PolynomialLevel, robustFitDoesNotMindFeaturesOnAFifthOfTheFrame) {
  const HeightMap clean = gaussianSurface(rough());
  cv::Mat heights = bent(clean).heights().clone();
  heights(cv::Rect(20, 30, 120, 100)) += 100e-9;  // a step of 100 nm on 19 %, off the middle
  const HeightMap surface(heights, kPitchX, kPitchY);
  const auto errorOf = [&](FitWeights weights) {
    const PolynomialSurface fit = fitPolynomial(surface, 2, weights);
    const HeightMap found = without(fit, bent(analytic::flat(200, 310, kPitchX, kPitchY)));
    return heightStatistics(found).rms_height;
  };
  EXPECT_GT(errorOf(FitWeights::kEqual), 20e-9);
  // the roughness itself has a polynomial part: 2 nm times the root of 5 terms over some 300
  // independent patches
  EXPECT_LT(errorOf(FitWeights::kRobust), 0.4e-9);
}

/// Rms of what is wrong in the fit of degree 1 to a tilted, rough ground with features on it.
double errorUnder(const cv::Mat& features) {
  const HeightMap clean = gaussianSurface(rough());
  const HeightMap tilt = analytic::tiltedPlane(200, 310, kPitchX, kPitchY, 0.02, -0.03);
  const HeightMap surface(clean.heights() + tilt.heights() + features, kPitchX, kPitchY);
  return heightStatistics(without(fitPolynomial(surface, 1, FitWeights::kRobust), tilt)).rms_height;
}

TEST(PolynomialLevel, tallFeaturesOnMostOfTheFrameDoNotTiltIt) {
  for (const double share : {0.2, 0.4, 0.6}) {
    cv::Mat ridge = cv::Mat::zeros(200, 310, CV_64FC1);
    ridge.colRange(10, 10 + static_cast<int>(share * 310)) += 100e-9;
    cv::Mat corner = cv::Mat::zeros(200, 310, CV_64FC1);
    corner(cv::Rect(8, 8, static_cast<int>(310 * std::sqrt(share)) - 8,
                    static_cast<int>(200 * std::sqrt(share)) - 8)) += 100e-9;
    // least squares err by 25 nm and more; the roughness itself has a tilt of 2 nm over some 300
    // independent patches
    EXPECT_LT(errorUnder(ridge), 0.6e-9) << share;
    EXPECT_LT(errorUnder(corner), 0.6e-9) << share;
  }
}

TEST(PolynomialLevel, tallFeaturesDoNotBendIt) {
  const HeightMap clean = gaussianSurface(rough());
  const HeightMap shape = bent(analytic::flat(200, 310, kPitchX, kPitchY));
  cv::Mat heights = clean.heights() + shape.heights();
  heights(cv::Rect(0, 0, 140, 200)) += 100e-9;  // 45 % of the frame
  heights.at<double>(100, 200) = std::numeric_limits<double>::quiet_NaN();
  const PolynomialSurface fit =
      fitPolynomial(HeightMap(heights, kPitchX, kPitchY), 2, FitWeights::kRobust);
  EXPECT_LT(heightStatistics(without(fit, shape)).rms_height, 1.0e-9);
}

TEST(PolynomialLevel, leavesInvalidPixelsInvalidAndOutOfTheFit) {
  const HeightMap surface = bent(analytic::flat(31, 44, kPitchX, kPitchY));
  cv::Mat heights = surface.heights().clone();
  heights.at<double>(3, 4) = std::numeric_limits<double>::infinity();
  heights(cv::Rect(20, 10, 5, 6)).setTo(std::numeric_limits<double>::quiet_NaN());
  const HeightMap holed(heights, kPitchX, kPitchY);
  const HeightMap flat = without(fitPolynomial(holed, 2, FitWeights::kRobust), holed);
  EXPECT_TRUE(std::isnan(flat.height(3, 4)));
  EXPECT_TRUE(std::isnan(flat.height(12, 22)));
  EXPECT_EQ(heightStatistics(flat).valid_count, 31 * 44 - 31);
  EXPECT_LT(heightStatistics(flat).rms_height, 1e-20);
}

TEST(PolynomialLevel, termsThatPixelsDoNotDetermineAreZero) {
  const HeightMap line = analytic::tiltedPlane(1, 50, kPitchX, kPitchY, 0.3, 0.0, 1e-6);
  const PolynomialSurface fit = fitPolynomial(line, 2, FitWeights::kRobust);
  EXPECT_NEAR(fit.coefficients[1] / fit.unit, 0.3, 1e-12);
  EXPECT_EQ(fit.coefficients[2], 0.0);
  EXPECT_NEAR(fit.height(49 * kPitchX, 0.0), line.height(0, 49), 1e-20);
  const cv::Mat nothing(3, 3, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_THROW(fitPolynomial(HeightMap(nothing, 1e-9, 1e-9), 1, FitWeights::kEqual), SurfaceError);
}

TEST(LevelOptions, planeIsThatOfLevelAndNoneChangesNothing) {
  const HeightMap surface = bent(gaussianSurface(rough()));
  LevelOptions options;
  EXPECT_EQ(largestDifference(levelledBy(surface, options), surface), 0.0);
  options.shape = LevelShape::kPlane;
  EXPECT_EQ(largestDifference(levelledBy(surface, options), levelled(surface)), 0.0);
  options.shape = LevelShape::kPolynomial;
  options.robust = true;
  // 2 nm of roughness are left, less its own polynomial part
  EXPECT_NEAR(heightStatistics(levelledBy(surface, options)).rms_height, 2e-9, 0.05e-9);
}

}  // namespace
}  // namespace mems_stiction
