/// Surfaces that are made by one transform have the variance and the slopes of their spectrum.

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "surface/tiled_surface.hpp"
#include "surface/whole_frame.hpp"

namespace mems_stiction {
namespace {

constexpr int kSide = 96;
constexpr double kPitch = 10e-9;

/// C ~ q^-3.6 between waves of 480 nm and 40 nm.
SurfaceSpectrum selfAffine() {
  SurfaceSpectrum spectrum;
  spectrum.wave_number = {2.0 * kPi / 480e-9 * 0.999, 2.0 * kPi / 480e-9, 2.0 * kPi / 40e-9};
  spectrum.density = {1e-40, 1e-30, 1e-30 * std::pow(12.0, -3.6)};
  return spectrum;
}

cv::Mat made(TiledSurface& surface) {
  cv::Mat heights(kSide, kSide, CV_64FC1);
  surface.heights(0, 0, heights);
  return heights;
}

/// Means over many surfaces of z^2 and of (z(x + pitch) - z(x))^2.
struct Moments {
  double square = 0.0;
  double step = 0.0;
};

Moments momentsOf(TiledSurface& surface, int count) {
  Moments moments;
  for (int seed = 1; seed <= count; ++seed) {
    surface.reseed(static_cast<std::uint64_t>(seed));
    const cv::Mat heights = made(surface);
    const cv::Mat steps = heights.colRange(1, kSide) - heights.colRange(0, kSide - 1);
    moments.square += cv::mean(heights.mul(heights))[0] / count;
    moments.step += cv::mean(steps.mul(steps))[0] / count;
  }
  return moments;
}

TEST(WholeFrame, hasTheVarianceAndTheStepsOfSurfacesMadeInBlocks) {
  TiledSurface whole(selfAffine(), kSide, kSide, kPitch, kPitch, 1, std::nullopt,
                     BlockChoice::kWhole);
  TiledSurface blocks(selfAffine(), kSide, kSide, kPitch, kPitch, 1, std::nullopt,
                      BlockChoice::kSmall);
  EXPECT_NEAR(whole.variance() / selfAffine().variance(), 1.0, 0.02)
      << "sampled at the waves of the frame";
  const int count = 40;
  const Moments of_whole = momentsOf(whole, count);
  // some four independent places a surface: 40 of them tell a variance to some 13 %
  EXPECT_NEAR(of_whole.square / whole.variance(), 1.0, 0.38);
  EXPECT_NEAR(of_whole.step / momentsOf(blocks, count).step, 1.0, 0.05);
}

TEST(WholeFrame, isTheSameForASeedWhateverIsAskedOfIt) {
  TiledSurface surface(selfAffine(), kSide, kSide, kPitch, kPitch, 7, std::nullopt,
                       BlockChoice::kWhole);
  const cv::Mat first = made(surface);
  surface.reseed(8);
  EXPECT_GT(cv::norm(made(surface), first, cv::NORM_INF), 0.0);
  surface.reseed(7);
  cv::Mat tile(10, 20, CV_64FC1);
  surface.heights(30, 40, tile);
  EXPECT_EQ(cv::norm(tile, first(cv::Rect(40, 30, 20, 10)), cv::NORM_INF), 0.0);
}

TEST(WholeFrame, doesNotMeetItselfAtItsEdges) {
  TiledSurface surface(selfAffine(), kSide, kSide, kPitch, kPitch, 1, std::nullopt,
                       BlockChoice::kWhole);
  double product = 0.0;
  const int count = 80;
  for (int seed = 1; seed <= count; ++seed) {
    surface.reseed(static_cast<std::uint64_t>(seed));
    const cv::Mat heights = made(surface);
    product += cv::mean(heights.col(0).mul(heights.col(kSide - 1)))[0] / count;
  }
  EXPECT_LT(std::abs(product), 0.4 * surface.variance())
      << "neighbours would have nearly all of it";
}

TEST(WholeFrame, ofAnEvenSpectrumIsTheSameByHalfOfIt) {
  const WavePower power = [](double x, double y) { return 1.0 / (0.01 + x * x + 2.0 * y * y); };
  for (const int rows : {kSide, kSide - 3}) {
    WholeFrame whole(power, rows, kSide);
    WholeFrame half(power, rows, kSide, true);
    EXPECT_NEAR(half.variance() / whole.variance(), 1.0, 1e-12);
    whole.make(NumberedNoise(5, 0));
    half.make(NumberedNoise(5, 0));
    // means over cells of waves are summed the other way round
    EXPECT_LT(cv::norm(whole.heights(), half.heights(), cv::NORM_INF),
              1e-6 * cv::norm(whole.heights(), cv::NORM_INF));
  }
}

}  // namespace
}  // namespace mems_stiction
