/// A potential that stays when the voltage has gone: plates, frames far apart, rough surfaces as
/// they were measured, and the half-space.

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/pinned_surface.hpp"
#include "support/sample_frames.hpp"
#include "support/separation_cases.hpp"

namespace mems_stiction {
namespace {

using separation_cases::elastic;
using separation_cases::rangeOf;

/// Two native oxides of 2 nm, d = 1.03 nm of vacuum.
Options charged(double contact_modulus, double contact_potential, double voltage = 0.0) {
  Options options = elastic(contact_modulus);
  options.interface.insulator_thickness = 4e-9;
  options.load.contact_potential = contact_potential;
  options.load.voltage = voltage;
  return options;
}

double insulatorOf(const Options& options) {
  return options.interface.insulator_thickness / options.interface.insulator_relative_permittivity;
}

/// Of plates at a gap, what parting them costs [J/m^2]; over the distance it is the pressure.
double fieldEnergy(const Options& options, double gap) {
  const double potential = options.load.contact_potential;
  return 0.5 * kVacuumPermittivity * potential * potential / (gap + insulatorOf(options));
}

double fieldPressure(const Options& options, double gap) {
  return fieldEnergy(options, gap) / (gap + insulatorOf(options));
}

Prediction predictWith(const Options& options, const HeightMap& surface) {
  return AdhesionModel(options).predict(surface);
}

TEST(ContactPotential, flatPlatesHoldWithLawAndField) {
  const HeightMap flat = analytic::flat(20, 30, 1e-9, 1e-9);
  for (const double potential : {0.2, 5.0}) {
    const Options options = charged(88.8e9, potential);
    const Prediction prediction = predictWith(options, flat);
    ASSERT_TRUE(prediction.is_conforming);
    const Prediction without = predictWith(charged(88.8e9, 0.0), flat);
    // the field hardly changes over the law's peak, from 0.2 z0 on: by 6 % of it
    const double gap = (std::pow(3.0, 1.0 / 6.0) - 1.0) * rangeOf(options);
    const double field = fieldPressure(options, gap) * prediction.nominal_area;
    EXPECT_NEAR(prediction.pull_off_force - without.pull_off_force, field, 0.02 * field)
        << potential;
    // to infinity, of which the branch sees what lies before springs have let go
    const double work = fieldEnergy(options, 0.0);
    EXPECT_NEAR(prediction.apparent_work_of_adhesion - without.apparent_work_of_adhesion, work,
                0.02 * work)
        << potential;
    EXPECT_NEAR(prediction.pull_off_exponents.contact_potential,
                2.0 * field / prediction.pull_off_force, 1e-3);
  }
}

TEST(ContactPotential, aFrameFarApartIsPulledAsPlatesAtItsMeanGap) {
  const double gap = 60e-9;
  const HeightMap rough = samples::gaussian(64, 64, 4e-9, 4e-9, 2e-9, 30e-9, 7);
  const double variance = std::pow(2e-9, 2.0);
  const double area = 64 * 64 * 16e-18;
  const double mean_gap = gap - cv::mean(rough.heights())[0];
  const HeightMap held = pinnedSurface(rough, gap);
  Options options = charged(1e15, 0.3);
  const Prediction prediction = predictWith(options, held);
  const Prediction without = predictWith(charged(1e15, 0.0), held);
  const double distance = mean_gap + insulatorOf(options);
  // moments of the gaps to second order; the pin touches with one pixel of 4097
  const double pin = fieldPressure(options, 0.0) * 16e-18;
  const double far = fieldPressure(options, mean_gap) * area;
  const double field = far * (1.0 + 3.0 * variance / (distance * distance)) + pin;
  EXPECT_NEAR(prediction.electrostatic_force / field, 1.0, 2e-3);
  EXPECT_NEAR((prediction.pull_off_force - without.pull_off_force) / field, 1.0, 0.05);
  // the work with it, per area of all pixels
  const double work = (fieldEnergy(options, mean_gap) * area + fieldEnergy(options, 0.0) * 16e-18) /
                      prediction.nominal_area;
  EXPECT_NEAR((prediction.apparent_work_of_adhesion - without.apparent_work_of_adhesion) / work,
              1.0, 0.01);
}

TEST(ContactPotential, addsToTheVoltageWhateverTheirSigns) {
  const HeightMap surface = samples::gaussian(64, 64, 4e-9, 4e-9, 3e-9, 30e-9, 5);
  const Prediction one = predictWith(charged(88.8e9, 1.0, 4.0), surface);
  const Prediction both = predictWith(charged(88.8e9, 0.0, 5.0), surface);
  EXPECT_EQ(one.electrostatic_force, both.electrostatic_force);
  EXPECT_EQ(one.approach, both.approach);
  for (const Options& other :
       {charged(88.8e9, -1.0, 4.0), charged(88.8e9, 1.0, -4.0), charged(88.8e9, -1.0, -4.0)}) {
    EXPECT_TRUE(separation_cases::sameFigures(predictWith(other, surface), one));
  }
}

TEST(ContactPotential, staysWhenTheVoltageIsTakenAway) {
  const HeightMap surface = samples::gaussian(64, 64, 4e-9, 4e-9, 3e-9, 30e-9, 5);
  const Prediction none = predictWith(charged(88.8e9, 0.0), surface);
  const Prediction voltage = predictWith(charged(88.8e9, 0.0, 1.0), surface);
  const Prediction potential = predictWith(charged(88.8e9, 1.0), surface);
  const Prediction both = predictWith(charged(88.8e9, 1.0, 1.0), surface);
  EXPECT_NEAR(voltage.pull_off_force / none.pull_off_force, 1.0, 1e-3);
  EXPECT_GT(potential.pull_off_force, 1.1 * none.pull_off_force);
  EXPECT_NEAR(both.pull_off_force / potential.pull_off_force, 1.0, 1e-3);
  EXPECT_EQ(voltage.electrostatic_force, potential.electrostatic_force);
}

/// The surfaces on which polysilicon was measured (doc/measured.md), a quarter of their area.
HeightMap measured(double rms_height) {
  return samples::gaussian(512, 512, 12.5e-9, 12.5e-9, rms_height, 100e-9, 3);
}

TEST(ContactPotential, addsToTheWorkOfMeasuredSurfacesWhatTheirMeanGapsSay) {
  for (const double rms_height : {2.6e-9, 10e-9}) {
    const HeightMap surface = measured(rms_height);
    const Prediction without = predictWith(charged(88.8e9, 0.0), surface);
    const double mean_gap = without.mean_gap;
    EXPECT_NEAR(mean_gap / rms_height, 4.3, 0.6);
    double before = 0.0;
    for (const double potential : {0.1, 0.3}) {
      const Options options = charged(88.8e9, potential);
      const Prediction prediction = predictWith(options, surface);
      const double added = prediction.apparent_work_of_adhesion - without.apparent_work_of_adhesion;
      // from the mean gap on; valleys count less than summits, by (sigma/D)^2 or so
      EXPECT_NEAR(added / fieldEnergy(options, mean_gap), 1.05, 0.1) << rms_height;
      EXPECT_GT(prediction.pull_off_force, std::max(before, without.pull_off_force));
      before = prediction.pull_off_force;
      const double factor =
          prediction.apparent_work_of_adhesion / without.apparent_work_of_adhesion;
      // a quarter and nine tenths more, 3 and 9 times as much on frames of four times the area
      const double said =
          rms_height < 5e-9 ? (potential < 0.2 ? 1.25 : 3.0) : (potential < 0.2 ? 1.9 : 9.0);
      EXPECT_NEAR(std::log(factor / said), 0.0, std::log(1.4)) << rms_height << " " << potential;
    }
  }
}

TEST(ContactPotential, exponentsAreTheChangesWithThePotential) {
  const HeightMap surface = samples::gaussian(96, 96, 4e-9, 4e-9, 3e-9, 30e-9, 11);
  const Prediction at = predictWith(charged(50e9, 0.5), surface);
  const double factor = 1.02;
  const Prediction moved = predictWith(charged(50e9, 0.5 * factor), surface);
  EXPECT_GT(at.pull_off_exponents.contact_potential, 0.05);
  EXPECT_NEAR(std::log(moved.pull_off_force / at.pull_off_force) / std::log(factor),
              at.pull_off_exponents.contact_potential, 0.02);
  EXPECT_NEAR(
      std::log(moved.apparent_work_of_adhesion / at.apparent_work_of_adhesion) / std::log(factor),
      at.work_exponents.contact_potential, 0.02);
}

TEST(ContactPotential, theHalfSpaceHoldsAsMuchMore) {
  for (const int seed : {1, 2}) {
    const HeightMap surface = samples::gaussian(48, 48, 4e-9, 4e-9, 3e-9, 25e-9, seed);
    const Options with = charged(60e9, 0.5);
    const Options without = charged(60e9, 0.0);
    const SolvedHalfSpace solved = separation_cases::halfSpaceOf(surface, with);
    const SolvedHalfSpace plain = separation_cases::halfSpaceOf(surface, without);
    ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
    const Prediction prediction = predictWith(with, surface);
    const Prediction plain_prediction = predictWith(without, surface);
    EXPECT_GT(solved.pull_off_force, 1.03 * plain.pull_off_force) << seed;
    EXPECT_NEAR((prediction.pull_off_force / plain_prediction.pull_off_force) /
                    (solved.pull_off_force / plain.pull_off_force),
                1.0, 0.03)
        << seed;
    EXPECT_NEAR(
        (prediction.apparent_work_of_adhesion / plain_prediction.apparent_work_of_adhesion) /
            (solved.work_of_adhesion / plain.work_of_adhesion),
        1.0, 0.05)
        << seed;
  }
}

TEST(ContactPotential, nothingIsAnotherWithoutOne) {
  const HeightMap surface = samples::gaussian(64, 64, 4e-9, 4e-9, 3e-9, 30e-9, 5);
  const Prediction plain = predictWith(elastic(88.8e9), surface);
  EXPECT_TRUE(separation_cases::sameFigures(predictWith(charged(88.8e9, 0.0), surface), plain));
  EXPECT_EQ(plain.pull_off_exponents.contact_potential, 0.0);
}

}  // namespace
}  // namespace mems_stiction
