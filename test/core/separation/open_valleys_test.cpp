/// Valleys that stay open, against the stress intensity of one wave, and what surfaces with open valleys hold, against the
/// half-space.

#include "separation/open_valleys.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/separation_cases.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 100e9;
constexpr double kWork = 0.05;
constexpr double kRange = 0.3e-9;
constexpr int kSide = 128;

/// One wave along each row, `cohesive_lengths` of the cohesive length long.
struct Wave {
  explicit Wave(double cohesive_lengths) {
    length = cohesive_lengths * BondedBodies{kModulus, kWork, kRange, 0.0, 0.0}.cohesiveLength();
    pitch = length / kSide;
  }

  BondedBodies bodiesWith(double amplitude) const {
    const double rms_height = amplitude / std::sqrt(2.0);
    return {kModulus, kWork, kRange, 0.25 * kModulus * waveNumber() * rms_height * rms_height, rms_height};
  }
  double waveNumber() const { return 2.0 * kPi / length; }
  /// K = E h sin(q a)/sqrt(pi a) is largest at tan(q a) = 2 q a, q a = 1.1656.
  double criticalAmplitude() const {
    const double largest = std::sin(1.1656) * std::sqrt(waveNumber() / (kPi * 1.1656));
    return std::sqrt(2.0 * kModulus * kWork) / (kModulus * largest);
  }
  bool staysOpen(double amplitude, double pressure = 0.0) const {
    GapField field;
    field.compute(analytic::sine(kSide, kSide, pitch, pitch, amplitude, 1, 0));
    const BondedBodies bodies = bodiesWith(amplitude);
    EXPECT_NEAR(bodies.waveNumber(), waveNumber(), 1e-9 * waveNumber());
    ReliefSpectrum relief;
    relief.take(field, 0.5 * bodies.cohesiveLength());
    return valleysStayOpen(relief, bodies, pressure);
  }

  double length = 0.0;
  double pitch = 0.0;
};

TEST(OpenValleys, aWaveStaysOpenFromItsCriticalAmplitudeOn) {
  const Wave wave(40.0);
  // up to 2 % are missed between two cracks
  EXPECT_FALSE(wave.staysOpen(0.99 * wave.criticalAmplitude()));
  EXPECT_TRUE(wave.staysOpen(1.03 * wave.criticalAmplitude()));
}

TEST(OpenValleys, pressureClosesThem) {
  const Wave wave(40.0);
  // what flattens the wave as a whole leaves no crack
  const double flattening = 0.5 * kModulus * wave.waveNumber() * wave.criticalAmplitude();
  EXPECT_TRUE(wave.staysOpen(1.1 * wave.criticalAmplitude()));
  EXPECT_TRUE(wave.staysOpen(1.1 * wave.criticalAmplitude(), 0.05 * flattening));
  EXPECT_FALSE(wave.staysOpen(1.1 * wave.criticalAmplitude(), 1.1 * flattening));
}

TEST(OpenValleys, wavesThatAreNotLongAgainstTheCohesiveLengthHaveNoCracks) {
  const Wave wave(3.0);
  EXPECT_FALSE(wave.staysOpen(10.0 * wave.criticalAmplitude()));
}

/// Of a wave with this tension when it is flat, over the strength of the law.
double strengthAgainstCracksOf(const Wave& wave, double share) {
  const double strength = 16.0 / (9.0 * std::sqrt(3.0)) * kWork / kRange;
  const double amplitude = 2.0 * share * strength / (kModulus * wave.waveNumber());
  GapField field;
  field.compute(analytic::sine(kSide, kSide, wave.pitch, wave.pitch, amplitude, 1, 0));
  const BondedBodies bodies = wave.bodiesWith(amplitude);
  ReliefSpectrum relief;
  relief.take(field, 0.5 * bodies.cohesiveLength());
  return strengthAgainstCracks(relief, bodies, strength, 10.0 * strength) / strength;
}

TEST(Cracks, beginAtTheDeepestPlaceOfALongWave) {
  // once a crack begins there, nothing holds a longer one: Johnson's full contact with a law of finite strength
  for (const double share : {0.2, 0.5}) EXPECT_NEAR(strengthAgainstCracksOf(Wave(100.0), share), 1.0 - share, 0.02);
}

TEST(Cracks, areHeldWhereTheWaveIsNoMoreUnderTension) {
  // (s^-2 + 4 a/(pi K^2))^-1/2 + (E h/2) sin(q a)/a is largest at an a > 0 where tension falls sooner than Irwin's strength
  const double at_once = 1.0 - 0.9;
  const double held = strengthAgainstCracksOf(Wave(12.0), 0.9);
  EXPECT_GT(held, at_once + 0.05);
  EXPECT_LT(held, 1.0);
}

TEST(Cracks, areNoneInWavesThatAreShorterThanThey) { EXPECT_EQ(strengthAgainstCracksOf(Wave(4.0), 0.5), 10.0); }

TEST(OpenValleys, brittleSurfacesHoldWhatTheHalfSpaceSays) {
  // a cohesive length of a tenth of the correlation length, flattening ratios of 0.6 to 0.8: by their patches, with the
  // work of bonded ones, these would hold 0.45 to 0.63 of the half-space's force
  for (const int seed : {1}) {
    Options options = separation_cases::elastic(kModulus);
    options.interface.work_of_adhesion = kWork;
    const double range = separation_cases::rangeOf(options);
    const double cohesive_length = kModulus * range * range / kWork;
    GaussianSurfaceOptions surface_options;
    surface_options.rows = surface_options.cols = 96;
    surface_options.correlation_length_x = surface_options.correlation_length_y = 10.0 * cohesive_length;
    surface_options.pitch_x = surface_options.pitch_y = 0.7 * cohesive_length;
    surface_options.rms_height = 4.0 * range;
    surface_options.seed = seed;
    const HeightMap surface = gaussianSurface(surface_options);
    const Prediction prediction = AdhesionModel(options).predict(surface);
    const SolvedHalfSpace solved = separation_cases::halfSpaceOf(surface, options);
    ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", flattening ratio " << prediction.flattening_ratio);
    const double ratio = prediction.pull_off_force / solved.pull_off_force;
    EXPECT_LT(std::abs(std::log(ratio)), std::log(1.3)) << ratio;
  }
}

}  // namespace
}  // namespace mems_stiction
