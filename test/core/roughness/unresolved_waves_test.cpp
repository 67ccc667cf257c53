/// Waves that pixels do not show, continued from those that they do: against surfaces whose whole
/// spectrum is known.

#include "mems_stiction/roughness/unresolved_waves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "surface/tiled_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kFinePitch = 2e-9;
constexpr int kFineSide = 2048;
constexpr double kNoTip = std::numeric_limits<double>::quiet_NaN();

/// Self-affine from waves of 2 um down to those of two fine pixels.
SurfaceSpectrum selfAffineOf(double hurst, double rms_height) {
  SurfaceSpectrum spectrum;
  spectrum.wave_number = {2.0 * kPi / 2e-6, kPi / kFinePitch};
  spectrum.density = {1.0, std::pow(2.0 * kFinePitch / 2e-6, 2.0 + 2.0 * hurst)};
  const double scale = rms_height * rms_height / spectrum.variance();
  for (double& density : spectrum.density) density *= scale;
  return spectrum;
}

/// exp(-(r/l)^2), by a table.
SurfaceSpectrum gaussianOf(double correlation_length, double rms_height) {
  SurfaceSpectrum spectrum;
  for (double q = 1e6; q < 10.0 / correlation_length; q *= 1.05) {
    spectrum.wave_number.push_back(q);
    spectrum.density.push_back(std::exp(-0.25 * std::pow(q * correlation_length, 2)));
  }
  const double scale = rms_height * rms_height / spectrum.variance();
  for (double& density : spectrum.density) density *= scale;
  return spectrum;
}

cv::Mat fineSurface(const SurfaceSpectrum& spectrum) {
  cv::Mat fine(kFineSide, kFineSide, CV_32FC1);
  TiledSurface(spectrum, kFineSide, kFineSide, kFinePitch, kFinePitch, 3).heights(0, 0, fine);
  return fine;
}

HeightMap everyPixel(const cv::Mat& fine, int factor) {
  const int side = kFineSide / factor;
  cv::Mat coarse(side, side, CV_32FC1);
  for (int row = 0; row < side; ++row) {
    for (int col = 0; col < side; ++col)
      coarse.at<float>(row, col) = fine.at<float>(row * factor, col * factor);
  }
  return {coarse, factor * kFinePitch, factor * kFinePitch};
}

/// H = 0.8, made once.
const cv::Mat& usualSurface() {
  static const cv::Mat surface = fineSurface(selfAffineOf(0.8, 3e-9));
  return surface;
}

/// Of the waves that are shorter than two pixels: what an endless self-affine spectrum has of them.
double shorterWaves(const SurfaceSpectrum& spectrum, double hurst, double pitch) {
  const double q = kPi / pitch;
  return std::sqrt(spectrum.densityAt(q) * q * q / (4.0 * kPi * hurst));
}

TEST(UnresolvedWaves, areThoseOfASelfAffineSurfaceBeyondItsPixels) {
  for (const double hurst : {0.5, 0.7, 0.9}) {
    const SurfaceSpectrum spectrum = selfAffineOf(hurst, 5e-9);
    const cv::Mat fine = fineSurface(spectrum);
    for (const int factor : {5, 10}) {
      const HeightMap scan = everyPixel(fine, factor);
      const UnresolvedWaves waves = unresolvedWaves(scan, {}, kNoTip);
      const double expected = shorterWaves(spectrum, hurst, scan.pitchX());
      EXPECT_NEAR(waves.hurst, hurst, 0.08) << factor;  // 200 and 400 pixels along a side
      EXPECT_NEAR(waves.rms_height, expected, 0.15 * expected) << hurst << " " << factor;
      EXPECT_DOUBLE_EQ(waves.shortest_shown, 2.0 * scan.pitchX());
    }
  }
}

TEST(UnresolvedWaves, areNoneWhereThePixelsShowTheWholeSpectrum) {
  const cv::Mat smooth = fineSurface(gaussianOf(100e-9, 3e-9));
  EXPECT_LT(unresolvedWaves(everyPixel(smooth, 2), {}, kNoTip).rms_height, 1e-12);
  EXPECT_LT(unresolvedWaves(everyPixel(smooth, 5), {}, kNoTip).rms_height, 0.03e-9);
  // pixels of 80 nm show no wave of the surface as it is: all of its height is open
  EXPECT_GT(unresolvedWaves(everyPixel(smooth, 40), {}, kNoTip).rms_height, 1e-9);
}

TEST(UnresolvedWaves, areNotThoseOfStepsParticlesAndMissingPixels) {
  const HeightMap scan = everyPixel(usualSurface(), 10);
  const double plain = unresolvedWaves(scan, {}, kNoTip).rms_height;
  cv::Mat heights = scan.heights().clone();
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = heights.cols / 2; col < heights.cols; ++col)
      heights.at<float>(row, col) += 100e-9F;
    heights.at<float>(row, row % 7 * 40) = 500e-9F;
    heights.at<float>(row, 11) = std::numeric_limits<float>::quiet_NaN();
  }
  const HeightMap spoilt(heights, scan.pitchX(), scan.pitchY());
  EXPECT_NEAR(unresolvedWaves(spoilt, {}, kNoTip).rms_height, plain, 0.3 * plain);
}

TEST(UnresolvedWaves, ofTwoSurfacesAreThoseOfTheirRelief) {
  const HeightMap scan = everyPixel(usualSurface(), 10);
  cv::Mat turned;
  cv::flip(scan.heights(), turned, 0);  // another surface, as far as waves go
  const double alone = unresolvedWaves(scan, {}, kNoTip).rms_height;
  const double both =
      unresolvedWaves(scan, {turned, scan.pitchX(), scan.pitchY()}, kNoTip).rms_height;
  EXPECT_NEAR(both, std::sqrt(2.0) * alone, 0.1 * alone);
}

TEST(UnresolvedWaves, beginWithTheTipWhereThatIsBlunterThanThePixels) {
  const SurfaceSpectrum spectrum = selfAffineOf(0.8, 3e-9);
  const HeightMap scan = everyPixel(usualSurface(), 2);
  const UnresolvedWaves waves = unresolvedWaves(scan, {}, 80e-9);
  EXPECT_DOUBLE_EQ(waves.shortest_shown, 80e-9);
  const double expected = shorterWaves(spectrum, 0.8, 40e-9);
  EXPECT_NEAR(waves.rms_height, expected, 0.15 * expected);
  EXPECT_DOUBLE_EQ(unresolvedWaves(scan, {}, 0.0).shortest_shown, 4.0 * kFinePitch);
  // a tip that has drawn all of the frame
  EXPECT_GT(unresolvedWaves(scan, {}, scan.cols() * scan.pitchX()).rms_height, 1e-9);
}

TEST(UnresolvedWaves, OfFramesTooSmallToTellAreNotKnown) {
  const HeightMap small(cv::Mat(12, 12, CV_64FC1, cv::Scalar(0.0)), 1e-8, 1e-8);
  EXPECT_TRUE(std::isnan(unresolvedWaves(small, {}, kNoTip).rms_height));
  const HeightMap other(cv::Mat(64, 60, CV_64FC1, cv::Scalar(0.0)), 1e-8, 1e-8);
  const HeightMap flat(cv::Mat(64, 64, CV_64FC1, cv::Scalar(0.0)), 1e-8, 1e-8);
  EXPECT_EQ(unresolvedWaves(flat, {}, kNoTip).rms_height, 0.0);
  EXPECT_TRUE(std::isnan(unresolvedWaves(flat, other, kNoTip).rms_height));
}

}  // namespace
}  // namespace mems_stiction
