/// Gaussian surfaces of one lateral correlation, from smooth to rough: the paper's conclusions.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/paper/paper_options.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "numeric/constants.hpp"
#include "support/paper_options.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;
constexpr double kCorrelation = 100 * kNm;

HeightMap surfaceOf(double rms_height, int seed) {
  return samples::gaussian(200, 250, 10 * kNm, 10 * kNm, rms_height, kCorrelation, seed);
}

Options optionsOf(Deformation deformation, double load = 0.0, double hardness = 12e9) {
  Options options = paperOptions();
  options.interface.hamaker_constant = 0.0;
  options.deformation = deformation;
  options.load.mechanical_load = load;
  options.lower.hardness = hardness;
  return options;
}

Prediction predict(const Options& options, double rms_height, int seed) {
  return AdhesionModel(options).predict(surfaceOf(rms_height, seed));
}

class RoughSurface : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Seeds, RoughSurface, testing::Values(1, 2, 3));

TEST_P(RoughSurface, bondsAtAnAdhesionParameterOfOneAndBelow) {
  for (const double rms_height : {0.05 * kNm, 0.1 * kNm, 0.2 * kNm}) {
    const Prediction prediction =
        predict(optionsOf(Deformation::kThreeRegimes), rms_height, GetParam());
    EXPECT_LT(prediction.adhesion_parameter, 1.2) << rms_height;
    EXPECT_EQ(prediction.status, Status::kBonded) << rms_height;
    EXPECT_GE(prediction.contact_fraction, 0.5);
    EXPECT_LT(prediction.contact_fraction, 0.51);  // the first level that reaches the limit
  }
}

TEST_P(RoughSurface, touchesAtAFewContactsFarAboveTwelve) {
  for (const double rms_height : {1.5 * kNm, 3.0 * kNm, 6.0 * kNm}) {
    const Prediction prediction =
        predict(optionsOf(Deformation::kThreeRegimes), rms_height, GetParam());
    EXPECT_GT(prediction.adhesion_parameter, 12.0) << rms_height;
    EXPECT_EQ(prediction.bonding_regime, BondingRegime::kNonBonding);
    EXPECT_EQ(prediction.status, Status::kEquilibrium) << rms_height;
    EXPECT_LE(prediction.asperity_count, 10) << rms_height;
    EXPECT_LT(prediction.contact_fraction, 0.01) << rms_height;
  }
}

TEST_P(RoughSurface, touchesLessTheRougherItIs) {
  double previous = 1.0;
  for (const double rms_height : {0.2, 0.45, 0.55, 0.7, 1.0, 1.5, 2.5, 4.0}) {
    const Prediction prediction =
        predict(optionsOf(Deformation::kThreeRegimes), rms_height * kNm, GetParam());
    EXPECT_LE(prediction.contact_fraction, previous * 1.05)
        << rms_height;  // few cells: one more or less
    previous = prediction.contact_fraction;
  }
  EXPECT_LT(previous, 1e-3);
}

TEST(RoughSurfaces, touchLessAndLessBetweenBondingAndNonBonding) {
  // one frame holds some twenty summits, so that a single high one can stop it early: the mean of
  // six frames
  constexpr int kFrames = 6;
  double previous = 1.0;
  double adhering = 0.0;
  for (const double rms_height : {0.2, 0.45, 0.55, 0.7, 1.0, 2.0}) {
    double fraction = 0.0;
    for (int seed = 1; seed <= kFrames; ++seed) {
      fraction +=
          predict(optionsOf(Deformation::kThreeRegimes), rms_height * kNm, seed).contact_fraction /
          kFrames;
    }
    EXPECT_LT(fraction, previous) << rms_height;
    previous = fraction;
    if (rms_height == 0.55) adhering = fraction;
  }
  EXPECT_GT(adhering, 0.01);
  EXPECT_LT(adhering, 0.4);
  EXPECT_LT(previous, 1e-3);
}

TEST_P(RoughSurface, neverSticksLessWithTheRegimesOnThanAllElastic) {
  int larger = 0, with_flow = 0;
  double ratios = 0.0, pairs = 0.0;
  for (const double load : {0.0, 1e-6, 2e-5}) {
    for (const double hardness : {12e9, 2e9}) {
      for (const double rms_height : {0.3, 0.7, 1.5, 3.0, 6.0}) {
        const Prediction regimes = predict(optionsOf(Deformation::kThreeRegimes, load, hardness),
                                           rms_height * kNm, GetParam());
        const Prediction elastic =
            predict(optionsOf(Deformation::kElastic, load, hardness), rms_height * kNm, GetParam());
        EXPECT_GE(regimes.contact_area, elastic.contact_area)
            << load << " " << hardness << " " << rms_height;
        EXPECT_GE(regimes.approach, elastic.approach)
            << load << " " << hardness << " " << rms_height;
        // R of a patch scatters with its pixels, and the pull-off follows it: contacts of a few by
        // a fifth
        EXPECT_GE(regimes.pull_off_force, 0.8 * elastic.pull_off_force)
            << load << " " << hardness << " " << rms_height;
        ratios += regimes.pull_off_force / elastic.pull_off_force;
        pairs += 1.0;
        if (regimes.contact_area > elastic.contact_area) {
          ++larger;
          EXPECT_GT(regimes.plastic_work, 0.0);
          // the larger contact may have the larger radius of an elastic one: what flowed then
          // flowed on the way
          if (regimes.elasto_plastic_count + regimes.plastic_count > 0) ++with_flow;
        }
        EXPECT_EQ(elastic.plastic_work, 0.0);
        EXPECT_EQ(elastic.elastic_count, elastic.asperity_count);
      }
    }
  }
  EXPECT_GT(larger, 10);
  EXPECT_GT(with_flow, larger / 2);
  EXPECT_GT(ratios, 1.2 * pairs);  // and holds more, in the mean
}

TEST_P(RoughSurface, pressesTogetherWithTheLoad) {
  double previous = 0.0;
  for (const double load : {0.0, 1e-7, 1e-6, 1e-5, 1e-4}) {
    const Prediction prediction =
        predict(optionsOf(Deformation::kThreeRegimes, load), 2 * kNm, GetParam());
    EXPECT_GE(prediction.contact_area, previous);
    EXPECT_EQ(prediction.normal_load, load);
    previous = prediction.contact_area;
    double shared = 0.0;
    for (const Asperity& asperity : prediction.asperities) shared += asperity.load;
    EXPECT_NEAR(shared, load, 1e-12 * load);
  }
}

TEST_P(RoughSurface, hardlyDependsOnTheStep) {
  const HeightMap surface = surfaceOf(1.5 * kNm, GetParam());
  Options options = optionsOf(Deformation::kThreeRegimes, 5e-6);
  const Prediction automatic = AdhesionModel(options).predict(surface);
  for (const double divisor : {20.0, 100.0, 500.0}) {
    options.solver.of<PaperOptions>().step = 1.5 * kNm / divisor;
    const Prediction prediction = AdhesionModel(options).predict(surface);
    EXPECT_EQ(prediction.status, automatic.status);
    EXPECT_NEAR(prediction.contact_area, automatic.contact_area, 0.05 * automatic.contact_area)
        << divisor;
    EXPECT_NEAR(prediction.pull_off_force, automatic.pull_off_force, 0.1 * automatic.pull_off_force)
        << divisor;
  }
}

TEST_P(RoughSurface, addsTheVanDerWaalsForceToThePullOff) {
  Options options = optionsOf(Deformation::kThreeRegimes);
  options.interface.hamaker_constant = 65e-21;
  const Prediction prediction = predict(options, 2 * kNm, GetParam());
  EXPECT_GT(prediction.van_der_waals_force, 0.0);
  EXPECT_DOUBLE_EQ(prediction.pull_off_force,
                   prediction.pull_off_force_jkr + prediction.van_der_waals_force);
  EXPECT_DOUBLE_EQ(prediction.normal_load, prediction.van_der_waals_force);
  EXPECT_GE(prediction.pull_off_force_transition, prediction.pull_off_force_jkr);
  EXPECT_LE(prediction.pull_off_force_transition,
            prediction.pull_off_force_jkr * 4.0 / 3.0 * (1 + 1e-12));
}

TEST_P(RoughSurface, publishesTheAdhesionParameterAndEnergiesOfItsContacts) {
  const Prediction prediction =
      predict(optionsOf(Deformation::kThreeRegimes, 1e-6), 1 * kNm, GetParam());
  const double modulus = ContactPair(Material(), Material()).contact_modulus;
  double parameter = 0.0;
  double radii = 0.0;
  for (const Asperity& asperity : prediction.asperities) {
    parameter +=
        modulus / 0.05 *
        std::sqrt(std::pow(prediction.composite_rms_height, 3) / asperity.composite_radius);
    radii += asperity.composite_radius;
  }
  parameter /= prediction.asperity_count;
  EXPECT_NEAR(prediction.adhesion_parameter, parameter, 1e-9 * parameter);
  EXPECT_NEAR(prediction.pull_off_force_jkr, 1.5 * kPi * 0.05 * radii,
              1e-9 * prediction.pull_off_force_jkr);
  EXPECT_DOUBLE_EQ(
      prediction.total_energy,
      prediction.mechanical_energy + prediction.surface_energy - prediction.elastic_energy);
  EXPECT_DOUBLE_EQ(prediction.bonding_energy, prediction.total_energy / prediction.nominal_area);
  EXPECT_DOUBLE_EQ(prediction.normalized_bonding_energy, prediction.bonding_energy / 0.05);
}

}  // namespace
}  // namespace mems_stiction
