/// Bonded surfaces: what springs hold and store, against closed forms and against the half-space.

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "separation/conforming_contact.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/separation_cases.hpp"

namespace mems_stiction {
namespace {

using separation_cases::elastic;
using separation_cases::halfSpaceOf;
using separation_cases::kWork;
using separation_cases::rangeOf;

double strengthOf(const Options& options) {
  return 16.0 / (9.0 * std::sqrt(3.0)) * options.interface.work_of_adhesion / rangeOf(options);
}

/// Amplitude of a wave that pulls with a share of the law's strength when it is pressed flat [m].
double amplitudeFor(double share, double wave_length, const Options& options, double modulus) {
  return share * strengthOf(options) * wave_length / (kPi * modulus);
}

TEST(ConformingContact, longWavesTearSoonerThanSpringsAndAreDoubted) {
  // wave and cohesive length (5 nm) are 1 : 60, pixels half of the latter
  const double modulus = 10e9;
  const Options options = elastic(modulus);
  const double pitch = 2.5e-9;
  const HeightMap wave =
      analytic::sine(8, 128, pitch, pitch, amplitudeFor(0.3, 128 * pitch, options, modulus), 1, 0);
  const SolvedHalfSpace solved = halfSpaceOf(wave, options);
  ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
  const Prediction prediction = AdhesionModel(options).predict(wave);
  ASSERT_TRUE(prediction.is_conforming);
  EXPECT_NE(prediction.model.doubt, nullptr);
  // Johnson's full contact: the law's strength less the tension of the flattened wave
  const double strength = 8 * 128 * pitch * pitch * strengthOf(options);
  EXPECT_NEAR(solved.pull_off_force / strength, 0.7, 0.07);
  EXPECT_GT(prediction.pull_off_force, 1.1 * solved.pull_off_force);
  EXPECT_LE(prediction.pull_off_force, strength);
}

/// Lines end at a quarter of the frame and miss most of a bow, half a wave of which lies inside.
TEST(ConformingContact, aBowTearsAsTheWaveThatItIsHalfOf) {
  const double modulus = 10e9;
  const Options options = elastic(modulus);
  const double pitch = 2.5e-9;
  constexpr int kRows = 8;
  constexpr int kCols = 128;
  const double amplitude = amplitudeFor(0.15, 2 * kCols * pitch, options, modulus);
  cv::Mat1d heights(kRows, 2 * kCols);
  for (int col = 0; col < heights.cols; ++col) {
    heights.col(col) = amplitude * std::cos(kPi * (col + 0.5) / kCols);
  }
  const Prediction prediction =
      AdhesionModel(options).predict(HeightMap(heights.colRange(0, kCols).clone(), pitch, pitch));
  ASSERT_TRUE(prediction.is_conforming);
  ASSERT_NE(prediction.model.doubt, nullptr);
  EXPECT_NE(std::string(prediction.model.doubt).find("long waves"), std::string::npos)
      << prediction.model.doubt;
  const SolvedHalfSpace solved = halfSpaceOf(HeightMap(heights, pitch, pitch), options);
  ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
  EXPECT_GT(2.0 * prediction.pull_off_force, 1.1 * solved.pull_off_force);
}

TEST(ConformingContact, shortWavesBreakAsAWhole) {
  // waves of 2.5 cohesive lengths (52 nm): each place hears of the others
  const double modulus = 100e9;
  const Options options = elastic(modulus);
  const double pitch = 8e-9;
  const HeightMap waves =
      analytic::sine(16, 64, pitch, pitch, amplitudeFor(0.3, 16 * pitch, options, modulus), 4, 0);
  const SolvedHalfSpace solved = halfSpaceOf(waves, options);
  ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
  const Prediction prediction = AdhesionModel(options).predict(waves);
  ASSERT_TRUE(prediction.is_conforming);
  EXPECT_NEAR(prediction.pull_off_force / solved.pull_off_force, 1.0, 0.1);
}

TEST(ConformingContact, waterHoldsBondedSurfaces) {
  const double modulus = 100e9;
  Options options = elastic(modulus);
  const double pitch = 8e-9;
  const HeightMap waves =
      analytic::sine(8, 64, pitch, pitch, amplitudeFor(0.3, 16 * pitch, options, modulus), 4, 0);
  const Prediction dry = AdhesionModel(options).predict(waves);
  ASSERT_TRUE(dry.is_conforming);
  options.capillary.relative_humidity = 0.3;
  for (const double film : {0.0, 0.8e-9}) {
    options.capillary.water_film = film;
    const SolvedHalfSpace solved = halfSpaceOf(waves, options);
    ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
    const Prediction prediction = AdhesionModel(options).predict(waves);
    ASSERT_TRUE(prediction.is_conforming);
    EXPECT_GT(prediction.pull_off_force, 1.1 * dry.pull_off_force);
    EXPECT_NEAR(prediction.pull_off_force / solved.pull_off_force, 1.0, 0.1) << film;
    EXPECT_NEAR(prediction.apparent_work_of_adhesion / solved.work_of_adhesion, 1.0, 0.1) << film;
  }
}

TEST(ConformingContact, groovesTakeTheHalfSpacesWork) {
  // along rows, flattened for half of what adhesion gives: by lines it would be 0.61 Gamma
  const double modulus = 10e9;
  const Options options = elastic(modulus);
  const double amplitude = std::sqrt(0.5 * kWork * 4.0 * 128e-9 / (kPi * modulus));
  const HeightMap grooves = analytic::sine(64, 64, 2e-9, 2e-9, amplitude, 1, 0);
  const SolvedHalfSpace solved = halfSpaceOf(grooves, options);
  ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
  const Prediction prediction = AdhesionModel(options).predict(grooves);
  ASSERT_TRUE(prediction.is_conforming);
  EXPECT_NEAR(prediction.apparent_work_of_adhesion / solved.work_of_adhesion, 1.0,
              0.17);  // of springs, which are all equal
}

TEST(ConformingContact, aLoadChangesTheRestButNotTheWork) {
  const double modulus = 10e9;
  const HeightMap wave = analytic::sine(32, 32, 2e-9, 2e-9, 0.1e-9, 1, 1);
  const Prediction free = AdhesionModel(elastic(modulus)).predict(wave);
  const Prediction pressed = AdhesionModel(elastic(modulus, 1e8 * 64e-9 * 64e-9)).predict(wave);
  ASSERT_TRUE(free.is_conforming);
  ASSERT_TRUE(pressed.is_conforming);
  EXPECT_GT(pressed.contact_area, free.contact_area);
  EXPECT_NEAR(pressed.apparent_work_of_adhesion / free.apparent_work_of_adhesion, 1.0, 1e-9);
  EXPECT_LT(free.apparent_work_of_adhesion, kWork);
}

TEST(ConformingContact, theCurveReachesThePullOffForceAndNoMore) {
  const HeightMap wave = analytic::sine(32, 32, 4e-9, 4e-9, 0.4e-9, 1, 0);
  const Prediction prediction = AdhesionModel(elastic(5e9)).predict(wave);
  ASSERT_TRUE(prediction.is_conforming);
  double largest = 0.0;
  for (const SeparationCurvePoint& point : prediction.curve) {
    if (point.is_separation) largest = std::max(largest, point.force);
  }
  EXPECT_NEAR(largest / prediction.pull_off_force, 1.0, 1e-9);
}

}  // namespace
}  // namespace mems_stiction
