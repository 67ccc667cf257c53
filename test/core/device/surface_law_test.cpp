#include "device/surface_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "device/made_surface.hpp"
#include "preprocess/level.hpp"
#include "support/gaussian_heights.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;

cv::Mat gaussianField(int side, double length, int seed) {
  return gaussianHeights(side, kPitch, length, 1.0, seed);
}

std::vector<HeightMap> partsOf(const cv::Mat& heights, int side) {
  std::vector<HeightMap> parts;
  for (int row = 0; row + side <= heights.rows; row += side) {
    for (int col = 0; col + side <= heights.cols; col += side) {
      parts.emplace_back(heights(cv::Rect(col, row, side, side)).clone(), kPitch, kPitch);
    }
  }
  return parts;
}

SurfaceLaw surfaceLawOf(const std::vector<HeightMap>& scans) { return SurfaceStudy(scans).law(); }

double skewnessOf(const cv::Mat& values) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(values, mean, deviation);
  cv::Mat third = (values - mean[0]) / deviation[0];
  cv::pow(third, 3, third);
  return cv::mean(third)[0];
}

cv::Mat made(const SurfaceLaw& law, int side, std::uint64_t seed) {
  MadeSurface surface(law, {}, {side, side, kPitch, kPitch}, side * kPitch, seed);
  cv::Mat heights(side, side, CV_32FC1);
  surface.heights(0, 0, heights);
  heights.convertTo(heights, CV_64F);
  return heights;
}

TEST(SurfaceLaw, GaussianSurfacesAreGaussian) {
  int gaussian = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    const SurfaceLaw law = surfaceLawOf(partsOf(3e-9 * gaussianField(1024, 100e-9, seed), 512));
    if (law.non_gaussian_share < 0.5) ++gaussian;
    EXPECT_NEAR(law.heights.rootMean(0, 1.0, 1e12) / 3e-9, 1.0, 0.15) << seed;
  }
  EXPECT_GE(gaussian, 2);
}

TEST(SurfaceLaw, SkewedSurfacesAreMadeAsSkewed) {
  cv::Mat heights;
  cv::exp(0.35 * gaussianField(1024, 80e-9, 3), heights);
  heights *= 5e-9;
  const SurfaceLaw law = surfaceLawOf(partsOf(heights, 512));
  EXPECT_GT(law.non_gaussian_share, 0.9);
  EXPECT_EQ(law.split_wave_number, 0.0);
  const cv::Mat again = made(law, 1024, 9);
  EXPECT_NEAR(skewnessOf(again), skewnessOf(heights), 0.25);
  cv::Scalar mean;
  cv::Scalar wanted;
  cv::Scalar found;
  cv::meanStdDev(heights, mean, wanted);
  cv::meanStdDev(again, mean, found);
  EXPECT_NEAR(found[0] / wanted[0], 1.0, 0.1);
}

TEST(SurfaceLaw, LongWavesOfTheWidestScanAreTakenAsTheyAre) {
  const cv::Mat large = 5e-9 * gaussianField(2048, 2e-6, 4) + 1e-9 * gaussianField(2048, 60e-9, 5);
  cv::Mat coarse;
  cv::resize(large, coarse, cv::Size(256, 256), 0.0, 0.0, cv::INTER_AREA);
  std::vector<HeightMap> scans{
      HeightMap(large(cv::Rect(700, 700, 512, 512)).clone(), kPitch, kPitch),
      HeightMap(coarse, 8 * kPitch, 8 * kPitch)};
  const SurfaceLaw law = surfaceLawOf(scans);
  ASSERT_TRUE(law.own);
  cv::Mat again = made(law, 2048, 1);
  cv::resize(again, again, cv::Size(256, 256), 0.0, 0.0, cv::INTER_AREA);
  cv::Mat difference = again - coarse;
  difference = levelled(HeightMap(difference, 8 * kPitch, 8 * kPitch)).heights();
  cv::Scalar mean;
  cv::Scalar left;
  cv::meanStdDev(difference, mean, left);
  EXPECT_LT(left[0], 1.5e-9);  // of 5 nm: what is drawn are waves shorter than 1.3 um
  // beyond it there are none: a larger device takes random ones
  EXPECT_GT(cv::norm(made(law, 2300, 1)(cv::Rect(0, 0, 512, 512)),
                     made(law, 2048, 1)(cv::Rect(0, 0, 512, 512))) /
                512,
            1e-9);
}

TEST(SurfaceLaw, TheSlopeOfTheLongestWavesTellsOfARollOff) {
  const SurfaceLaw rolled_off = surfaceLawOf(partsOf(3e-9 * gaussianField(1024, 100e-9, 6), 512));
  EXPECT_LT(rolled_off.slope, 3.0 * rolled_off.slope_deviation);
  const cv::Mat steep = filteredNoise(whiteNoise(2048, 2048, 1), [](int row, int col) {
    if (row == 0 && col == 0) return 0.0;
    return std::pow(std::hypot(waveNumber(col, 2048, kPitch), waveNumber(row, 2048, kPitch)), -1.8);
  });
  const SurfaceLaw rising = surfaceLawOf(partsOf(steep, 512));
  EXPECT_NEAR(rising.slope, 3.6, 4.0 * rising.slope_deviation);
  EXPECT_GT(rising.slope, 1.0);
  EXPECT_GT(rising.slope, 2.0 * rising.slope_deviation);
}

}  // namespace
}  // namespace mems_stiction
