/// Long waves of a relief and the tension with which they pull at a bonded interface, against Westergaard's pressure.

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "separation/relief_waves.hpp"
#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 2e9;
constexpr double kAmplitude = 1e-9;
constexpr double kPitch = 2e-9;
constexpr int kSide = 96;

ReliefWaves split(const HeightMap& surface, double cohesive_length) {
  GapField field;
  field.compute(surface);
  ReliefSpectrum relief;
  relief.take(field, ReliefWaves::blockLength(cohesive_length));
  ReliefWaves waves;
  waves.split(relief, {surface.cols(), surface.rows()}, kModulus, cohesive_length);
  return waves;
}

double fullPressure(double wave_length) { return kModulus * kPi * kAmplitude / wave_length; }

TEST(ReliefWaves, aLongWavePullsWithWestergaardsPressure) {
  const double wave_length = kSide * kPitch;
  const double phase = 2.0 * kPi / kSide;  // l q
  const double long_part = 1.0 / (1.0 + phase * phase);
  const ReliefWaves waves = split(analytic::sine(kSide, kSide, kPitch, kPitch, kAmplitude, 1, 0), kPitch);
  EXPECT_NEAR(waves.largestTension() / (long_part * fullPressure(wave_length)), 1.0, 2e-3);
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(waves.longHeights(), &low, &high);
  EXPECT_NEAR(high, kAmplitude, 0.01 * kAmplitude);
  EXPECT_NEAR(low, -kAmplitude, 0.01 * kAmplitude);
}

TEST(ReliefWaves, pitchesMayDiffer) {
  const ReliefWaves waves = split(analytic::sine(kSide, kSide / 2, kPitch, 3.0 * kPitch, kAmplitude, 0, 1), kPitch);
  EXPECT_NEAR(waves.largestTension() / fullPressure(3.0 * kPitch * kSide), 1.0, 5e-3);
}

TEST(ReliefWaves, shortWavesPullNoPlaceApart) {
  const double wave_length = kSide * kPitch / 12.0;
  const ReliefWaves waves = split(analytic::sine(kSide, kSide, kPitch, kPitch, kAmplitude, 12, 0), 2.0 * wave_length);
  EXPECT_LT(waves.largestTension(), 1e-4 * fullPressure(wave_length));
  EXPECT_LT(cv::norm(waves.longHeights(), cv::NORM_INF), 1e-3 * kAmplitude);
}

TEST(ReliefWaves, edgesThatDoNotFitPullNoHarderThanAMirror) {
  // repeated, the step of a tilted plane would pull without limit
  const HeightMap tilted = analytic::tiltedPlane(kSide, kSide, kPitch, kPitch, 1e-2, 0.0);
  const double height = 1e-2 * kSide * kPitch;
  const double as_one_wave = kModulus * kPi * 0.5 * height / (2.0 * kSide * kPitch);
  EXPECT_LT(split(tilted, kPitch).largestTension(), 4.0 * as_one_wave);
}

TEST(ReliefWaves, missingCellsLieAtTheMean) {
  const HeightMap whole = analytic::sine(kSide, kSide, kPitch, kPitch, kAmplitude, 2, 0);
  const double tension = split(whole, 4.0 * kPitch).largestTension();
  EXPECT_NEAR(split(analytic::withInvalidPixel(whole, 40, 40), 4.0 * kPitch).largestTension(), tension, 0.02 * tension);
}

TEST(ReliefWaves, aLongerCohesiveLengthTakesLongerWavesForShort) {
  const HeightMap surface = analytic::sine(kSide, kSide, kPitch, kPitch, kAmplitude, 3, 0);
  double last = split(surface, kPitch).largestTension();
  for (const double length : {4.0, 8.0, 16.0}) {
    const double tension = split(surface, length * kPitch).largestTension();
    EXPECT_LT(tension, last);
    last = tension;
  }
}

}  // namespace
}  // namespace mems_stiction
