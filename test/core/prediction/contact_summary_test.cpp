/// Limits and medians among the figures of a prediction.

#include "mems_stiction/prediction/contact_summary.hpp"

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/sphere_contact.hpp"

namespace mems_stiction {
namespace {

constexpr double kWork = 0.05;
constexpr double kNm = 1e-9;

HeightMap sphere() { return analytic::paraboloid(101, 101, kNm, kNm, 2e-6); }

/// The sphere with the work of adhesion at which its adhesion parameter is this. Its radius moves with the contact by
/// less than 3 % (twenty pixels), the parameter by half of that.
Prediction withAdhesionParameter(double parameter) {
  const double at_work = AdhesionModel(contactOnly(1e-6, kWork)).predict(sphere()).adhesion_parameter;
  return AdhesionModel(contactOnly(1e-6, kWork * at_work / parameter)).predict(sphere());
}

TEST(ContactSummary, namesTheBondingRegimeByGuisLimits) {
  EXPECT_EQ(withAdhesionParameter(0.95).bonding_regime, BondingRegime::kBonding);
  EXPECT_EQ(withAdhesionParameter(1.05).bonding_regime, BondingRegime::kAdherence);
  EXPECT_EQ(withAdhesionParameter(11.5).bonding_regime, BondingRegime::kAdherence);
  EXPECT_EQ(withAdhesionParameter(12.5).bonding_regime, BondingRegime::kNonBonding);
}

/// The same contact with the equilibrium distance at which its Tabor parameter is this: mu goes with 1/z0.
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
  EXPECT_DOUBLE_EQ(found.median_composite_radius, 0.5 * (first.composite_radius + second.composite_radius));
  EXPECT_DOUBLE_EQ(found.median_tabor_parameter, 0.5 * (first.tabor_parameter + second.tabor_parameter));
  EXPECT_NEAR(found.median_contact_pixels, 0.5 * (first.area + second.area) / (kNm * kNm), 1e-6);  // whole numbers
  EXPECT_GT(second.composite_radius / first.composite_radius + first.composite_radius / second.composite_radius, 2.1);
}

}  // namespace
}  // namespace mems_stiction
