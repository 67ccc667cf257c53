#include "device/longer_waves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;

/// C ~ q^-3 between waves of 10 um and 20 nm.
MergedSpectrum steep() {
  MergedSpectrum spectrum;
  for (const double wavelength : {10e-6, 1e-6, 100e-9, 20e-9}) {
    const double q = 2.0 * kPi / wavelength;
    spectrum.bands.push_back({q, 1e-11 * std::pow(q, -3.0), 100.0});
  }
  spectrum.largest_wave_number = spectrum.bands.back().wave_number;
  return spectrum;
}

TEST(LongerWaves, HeightsHaveTheSpectrumsVarianceAndCorrelation) {
  const MergedSpectrum spectrum = steep();
  const double from = 2.0 * kPi / 5e-6;
  const double to = 2.0 * kPi / 400e-9;
  LongerWaves waves(spectrum, from, to, [](double) { return 0.5; });
  constexpr int kApart = 100;  // pixels
  constexpr int kDraws = 4000;
  std::mt19937_64 engine(1);
  double square = 0.0;
  double product = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    waves.draw(engine);
    cv::Mat tile = cv::Mat::zeros(1, kApart + 1, CV_32FC1);
    waves.addTo(tile, 0.0, 0.0, kPitch, kPitch);
    square += std::pow(tile.at<float>(0, 0), 2) / kDraws;
    product += static_cast<double>(tile.at<float>(0, 0)) * tile.at<float>(0, kApart) / kDraws;
  }
  double correlated = 0.0;  // of isotropic waves: J0 of wave number and distance
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double first = from * std::pow(to / from, i / 1000.0);
    const double last = from * std::pow(to / from, (i + 1) / 1000.0);
    correlated += 0.5 * std::pow(spectrum.rootMean(0, first, last), 2) *
                  std::cyl_bessel_j(0.0, std::sqrt(first * last) * kApart * kPitch);
  }
  const double variance = 0.5 * std::pow(spectrum.rootMean(0, from, to), 2);
  EXPECT_NEAR(square / variance, 1.0, 0.08);
  EXPECT_NEAR(product / variance, correlated / variance, 0.08);
}

TEST(LongerWaves, TilesFitTogetherAndNoWaveIsFlat) {
  const MergedSpectrum spectrum = steep();
  LongerWaves waves(spectrum, 2.0 * kPi / 5e-6, 2.0 * kPi / 400e-9, [](double) { return 1.0; });
  std::mt19937_64 engine(1);
  waves.draw(engine);
  cv::Mat whole = cv::Mat::zeros(20, 30, CV_32FC1);
  waves.addTo(whole, 0.0, 0.0, kPitch, kPitch);
  cv::Mat part = cv::Mat::zeros(8, 10, CV_32FC1);
  waves.addTo(part, 12 * kPitch, 5 * kPitch, kPitch, kPitch);
  EXPECT_LT(cv::norm(whole(cv::Rect(12, 5, 10, 8)), part, cv::NORM_INF), 1e-6 * cv::norm(whole));
  LongerWaves none(spectrum, 1e8, 1e7, [](double) { return 1.0; });
  none.draw(engine);
  cv::Mat flat = cv::Mat::zeros(8, 8, CV_32FC1);
  none.addTo(flat, 0.0, 0.0, kPitch, kPitch);
  EXPECT_EQ(cv::countNonZero(flat), 0);
}

}  // namespace
}  // namespace mems_stiction
