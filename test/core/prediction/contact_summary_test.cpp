/// Limits and medians among the figures of a prediction.

#include "prediction/contact_summary.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "prediction/asked_output.hpp"
#include "prediction/prediction_fields.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/sphere_contact.hpp"

namespace mems_stiction {
namespace {

constexpr double kWork = 0.05;
constexpr double kNm = 1e-9;

HeightMap sphere() { return analytic::paraboloid(101, 101, kNm, kNm, 2e-6); }

/// The sphere with the work of adhesion at which its adhesion parameter is this. Its radius moves
/// with the contact by less than 3 % (twenty pixels), the parameter by half of that.
Prediction withAdhesionParameter(double parameter) {
  const double at_work =
      AdhesionModel(contactOnly(1e-6, kWork)).predict(sphere()).adhesion_parameter;
  return AdhesionModel(contactOnly(1e-6, kWork * at_work / parameter)).predict(sphere());
}

TEST(ContactSummary, namesTheBondingRegimeByGuisLimits) {
  EXPECT_EQ(withAdhesionParameter(0.95).bonding_regime, BondingRegime::kBonding);
  EXPECT_EQ(withAdhesionParameter(1.05).bonding_regime, BondingRegime::kAdherence);
  EXPECT_EQ(withAdhesionParameter(11.5).bonding_regime, BondingRegime::kAdherence);
  EXPECT_EQ(withAdhesionParameter(12.5).bonding_regime, BondingRegime::kNonBonding);
}

/// The same contact with the equilibrium distance at which its Tabor parameter is this: mu goes
/// with 1/z0.
Prediction withTaborParameter(double parameter) {
  Options options = contactOnly(1e-6, kWork);
  options.interface.equilibrium_distance = 0.2 * kNm;
  const double at_distance = AdhesionModel(options).predict(sphere()).median_tabor_parameter;
  options.interface.equilibrium_distance *= at_distance / parameter;
  return AdhesionModel(options).predict(sphere());
}

TEST(ContactSummary, namesTheContactTheoryByJohnsonAndGreenwoodsLimits) {
  EXPECT_EQ(withTaborParameter(0.099).contact_theory, ContactTheory::kDmt);
  EXPECT_EQ(withTaborParameter(0.101).contact_theory, ContactTheory::kTransition);
  EXPECT_EQ(withTaborParameter(4.99).contact_theory, ContactTheory::kTransition);
  EXPECT_EQ(withTaborParameter(5.01).contact_theory, ContactTheory::kJkr);
}

TEST(ContactSummary, takesTheMeanOfTheMiddleTwoAsMedianOfAnEvenNumber) {
  const HeightMap surface = analytic::sphereArray(80, 160, kNm, kNm, {1e-6, 2e-6}, 2, 1);
  const Prediction found = AdhesionModel(contactOnly(4e-7, kWork)).predict(surface);
  ASSERT_EQ(found.asperity_count, 2);
  const Asperity& first = found.asperities[0];
  const Asperity& second = found.asperities[1];
  EXPECT_DOUBLE_EQ(found.median_composite_radius,
                   0.5 * (first.composite_radius + second.composite_radius));
  EXPECT_DOUBLE_EQ(found.median_tabor_parameter,
                   0.5 * (first.tabor_parameter + second.tabor_parameter));
  EXPECT_NEAR(found.median_contact_pixels, 0.5 * (first.area + second.area) / (kNm * kNm),
              1e-6);  // whole numbers
  EXPECT_GT(second.composite_radius / first.composite_radius +
                first.composite_radius / second.composite_radius,
            2.1);
}

/// A solver that knows the state and what parts it, and nothing of single contacts.
Prediction ofASolverWithoutAsperities(const HeightMap& surface, const Options& options) {
  GapField gap;
  gap.compute(surface);
  const SurfacePair surfaces = surface;
  ContactSolution solution;
  solution.status = Status::kEquilibrium;
  solution.approach = 2 * kNm;
  solution.contact_area = 50 * gap.cellArea();
  solution.contact_fraction = 50.0 / gap.validCount();
  solution.pull_off_force = 3e-7;
  std::vector<double> values;
  Prediction prediction;
  summarizeContact({surfaces, gap, gap.rmsGap(), options}, solution, values, prediction);
  return prediction;
}

TEST(ContactSummary, saysOfFiguresThatASolverDoesNotHaveThatTheyAreUnknown) {
  const Prediction found = ofASolverWithoutAsperities(sphere(), contactOnly(1e-6, kWork));
  EXPECT_EQ(found.pull_off_force, 3e-7);
  EXPECT_DOUBLE_EQ(found.contact_area, 50 * kNm * kNm);
  for (const double unknown :
       {found.pull_off_force_jkr, found.pull_off_force_transition, found.contact_area_jkr,
        found.adhesion_parameter, found.total_energy, found.bonding_energy, found.plastic_work,
        found.max_tilt, found.median_tabor_parameter, found.median_contact_pixels,
        found.median_composite_radius, found.mean_gap}) {
    EXPECT_TRUE(std::isnan(unknown));
  }
  EXPECT_EQ(found.asperity_count, 0);
  EXPECT_FALSE(found.listsContacts());
  EXPECT_STREQ(word(found.bonding_regime), "UNKNOWN");
  EXPECT_STREQ(word(found.contact_theory), "UNKNOWN");
  EXPECT_THROW(requireDeformedSurfaces(found), SurfaceError);
}

TEST(ContactSummary, aSolverWithoutAsperitiesGivesAMarginOfUnknownSpread) {
  const Options options = contactOnly(1e-6, kWork);
  const Prediction found = ofASolverWithoutAsperities(sphere(), options);
  DeviceOptions device;
  device.spring_stiffness = 1.0;
  device.travel = 1e-6;
  device.contact_area = found.nominal_area;
  const Verdict verdict = verdictOf(found, device, UncertaintyOptions(), options, kNm * kNm);
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_DOUBLE_EQ(verdict.margin, 1e-6 / 3e-7);
  EXPECT_TRUE(std::isnan(verdict.margin_lower));
  EXPECT_TRUE(std::isnan(verdict.margin_upper));
}

}  // namespace
}  // namespace mems_stiction
