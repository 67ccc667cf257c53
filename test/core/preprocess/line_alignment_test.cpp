#include "preprocess/line_alignment.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "preprocess/stage_offset.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

HeightMap withoutStageOffset(const HeightMap& surface) {
  WorkingSurface work(surface);
  subtractStageOffset(work);
  return work.surface();
}

HeightMap withAlignedLines(const HeightMap& surface, const LineAlignmentOptions& options) {
  WorkingSurface work(surface);
  alignLines(work, options);
  return work.surface();
}

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

LineAlignmentOptions byMethod(LineAlignment method, int degree = 1) {
  LineAlignmentOptions options;
  options.method = method;
  options.degree = degree;
  return options;
}

/// Each row lifted by its own amount, and optionally tilted.
HeightMap jumping(const HeightMap& surface, double jump, double tilt = 0.0) {
  cv::Mat heights = surface.heights().clone();
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (int row = 0; row < heights.rows; ++row) {
    const double lift = jump * normal(engine);
    const double slope = tilt * normal(engine);
    for (int col = 0; col < heights.cols; ++col)
      heights.at<double>(row, col) += lift + slope * col / heights.cols;
  }
  return {heights, surface.pitchX(), surface.pitchY()};
}

double rmsDifference(const HeightMap& first, const HeightMap& second) {
  return heightStatistics(HeightMap(first.heights() - second.heights(), 1.0, 1.0)).rms_height;
}

/// A surface whose rows all have the same median, so that nothing but the jumps is there to take
/// off.
HeightMap stripes() { return analytic::sine(64, 96, 10e-9, 20e-9, 2e-9, 3, 0); }

TEST(LineAlignment, takesJumpsOffExactly) {
  const HeightMap jumped = jumping(stripes(), 50e-9);
  for (const LineAlignment method : {LineAlignment::kMedian, LineAlignment::kMedianDifference}) {
    EXPECT_LT(rmsDifference(withAlignedLines(jumped, byMethod(method)), stripes()), 1e-20);
  }
}

TEST(LineAlignment, polynomialTakesTheTiltOfEachLineOff) {
  const HeightMap jumped = jumping(analytic::flat(64, 96, 10e-9, 20e-9), 50e-9, 30e-9);
  const HeightMap found = withAlignedLines(jumped, byMethod(LineAlignment::kPolynomial));
  EXPECT_LT(heightStatistics(found).rms_height, 1e-20);
}

TEST(LineAlignment, doesNotMindAFeatureOnTwoFifthsOfTheLines) {
  cv::Mat heights = stripes().heights().clone();
  heights(cv::Rect(10, 20, 38, 25)) += 80e-9;
  const HeightMap truth(heights, 10e-9, 20e-9);
  const HeightMap found =
      withAlignedLines(jumping(truth, 20e-9), byMethod(LineAlignment::kMedianDifference));
  // where the feature starts and ends, 60 % of the differences are exactly 0
  EXPECT_LT(rmsDifference(found, truth), 1e-20);
}

TEST(LineAlignment, bringsTheRoughnessBackBeneathLargeJumps) {
  GaussianSurfaceOptions options;
  options.rms_height = 3e-9;
  options.correlation_length_x = options.correlation_length_y = 50e-9;
  const HeightMap clean = gaussianSurface(options);
  const HeightMap jumped = jumping(clean, 20e-9);
  // Every line takes the median of its own roughness with it: 1.25 sigma over the root of some 5.12
  // um/90 nm patches.
  EXPECT_LT(rmsDifference(withAlignedLines(jumped, byMethod(LineAlignment::kMedian)), clean),
            0.25 * 3e-9);
}

TEST(LineAlignment, keepsMeanInvalidPixelsAndEmptyLines) {
  cv::Mat heights = jumping(stripes(), 5e-9).heights().clone();
  heights += 0.01;
  heights.row(10).setTo(kMissing);
  heights.row(0).setTo(kMissing);
  heights.at<double>(20, 30) = kMissing;
  const HeightMap holed(heights, 10e-9, 20e-9);
  for (const LineAlignment method :
       {LineAlignment::kMedian, LineAlignment::kMedianDifference, LineAlignment::kPolynomial}) {
    const HeightMap found = withAlignedLines(holed, byMethod(method, 0));
    EXPECT_EQ(heightStatistics(found).valid_count, 62 * 96 - 1);
    EXPECT_TRUE(std::isnan(found.height(20, 30)));
    EXPECT_NEAR(heightStatistics(found).mean, heightStatistics(holed).mean,
                5e-15);  // a sum of 6000 heights of 10 mm
    EXPECT_NEAR(heightStatistics(found).rms_height, 2e-9 / std::sqrt(2.0), 0.02e-9);
  }
}

TEST(StageOffset, isSubtractedInDouble) {
  cv::Mat heights = stripes().heights() + 0.0123;
  const HeightMap found = withoutStageOffset(HeightMap(heights, 10e-9, 20e-9));
  EXPECT_NEAR(heightStatistics(found).mean, 0.0, 1e-17);
  EXPECT_LT(rmsDifference(found, stripes()), 1e-18);  // a double at 12 mm is spaced by 1.7e-18 m
  const HeightMap single = withoutStageOffset(analytic::asSingle(stripes()));
  EXPECT_EQ(single.heights().type(), CV_64FC1);
}

}  // namespace
}  // namespace mems_stiction
