/// The flattening energy by waves, against that of one wave.

#include "separation/flattening_waves.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kContactModulus = 10e9;
constexpr double kWaveAmplitude = 0.1e-9;

double byWaves(const HeightMap& surface) {
  GapField field;
  field.compute(surface);
  return FlatteningWaves().of(field, kContactModulus);
}

/// (E/4) q <h^2>.
double ofWave(double wave_number) {
  return 0.25 * kContactModulus * wave_number * 0.5 * kWaveAmplitude * kWaveAmplitude;
}

TEST(FlatteningWaves, groovesCostTheSameInEachDirection) {
  // lines along rows and columns alone tell 0.79 of it along one of them, 1.11 between
  const double pitch = 2e-9;
  for (const cv::Point waves :
       {cv::Point(2, 0), cv::Point(0, 2), cv::Point(2, 2), cv::Point(5, 2)}) {
    SCOPED_TRACE(testing::Message() << waves);
    const double energy =
        byWaves(analytic::sine(64, 64, pitch, pitch, kWaveAmplitude, waves.x, waves.y));
    EXPECT_NEAR(energy / ofWave(2.0 * kPi * std::hypot(waves.x, waves.y) / (64 * pitch)), 1.0,
                0.03);
  }
}

TEST(FlatteningWaves, pitchesMayDiffer) {
  const double energy = byWaves(analytic::sine(96, 48, 2e-9, 6e-9, kWaveAmplitude, 0, 1));
  EXPECT_NEAR(energy / ofWave(2.0 * kPi / (96 * 6e-9)), 1.0, 0.03);
}

TEST(FlatteningWaves, largeFramesAreTakenInBlocks) {
  const double energy = byWaves(analytic::sine(600, 1100, 1e-9, 1e-9, kWaveAmplitude, 3, 0));
  EXPECT_NEAR(energy / ofWave(2.0 * kPi * 3.0 / 1100e-9), 1.0, 0.03);
}

TEST(FlatteningWaves, missingCellsLieAtTheMean) {
  const HeightMap whole = analytic::sine(64, 64, 2e-9, 2e-9, kWaveAmplitude, 2, 0);
  EXPECT_NEAR(byWaves(analytic::withInvalidPixel(whole, 40, 40)) / byWaves(whole), 1.0, 0.02);
}

TEST(FlatteningWaves, edgesThatDoNotFitAreMirrored) {
  // repeated, the step of a tilted plane would cost without limit as pixels become smaller
  const auto ofPlane = [](int side) {
    return byWaves(analytic::tiltedPlane(side, side, 128e-9 / side, 128e-9 / side, 1e-2, 0.0));
  };
  EXPECT_NEAR(ofPlane(128) / ofPlane(64), 1.0, 0.1);
}

}  // namespace
}  // namespace mems_stiction
