/// A relief on springs: the law alone where nothing gives way, the energy of flattening where all
/// is flat.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "separation/spring_contact.hpp"

namespace mems_stiction {
namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();
const FieldLaw kNoField(0.0, 0.0, 1.0);

ContactTraction law() {
  InterfaceOptions interface;
  interface.work_of_adhesion = 0.05;
  interface.hamaker_constant = 65e-21;
  return ContactTraction(interface);
}

TEST(SpringContact, aPlaneHasTheStrengthAndTheEnergyOfTheLaw) {
  const ContactTraction traction = law();
  const auto branch = springBranch({{0.0, 1.0}}, traction, kNoField, WaterLaw(), kRigid);
  const auto rest = restOf(branch, 0.0);
  EXPECT_NEAR(rest->energy, -0.05, 1e-4 * 0.05);
  EXPECT_NEAR(strengthFrom(rest, branch) / traction.strength(), 1.0, 1e-3);
  EXPECT_EQ(repellingShare(rest, branch, 0.0, {{0.0, 1.0}}, traction.range()), 1.0);
}

TEST(SpringContact, waterAddsItsPressureAndItsEnergy) {
  const ContactTraction traction = law();
  const WaterLaw water(0.3, 0.072, 0.0, 298.15, 18.07e-6, 0.8e-9);
  const auto branch = springBranch({{0.0, 1.0}}, traction, kNoField, water, kRigid);
  const auto rest = restOf(branch, 0.0);
  EXPECT_NEAR(rest->energy, -(0.05 + water.energy(0.0)), 1e-3 * water.energy(0.0));
  EXPECT_NEAR(strengthFrom(rest, branch) / (traction.strength() + water.pressure()), 1.0, 1e-3);
  // drawn out on springs it holds to the same width, and no less before
  const double stiffness = 2.0 * water.pressure() / water.gapLimit();
  const auto soft = springBranch({{0.0, 1.0}}, traction, kNoField, water, stiffness);
  const double width = traction.range() + water.gapLimit();
  EXPECT_NEAR(soft.back().height, width + water.pressure() / stiffness, 0.02 * width);
  EXPECT_NEAR(strengthFrom(restOf(soft, 0.0), soft) / (traction.strength() + water.pressure()), 1.0,
              0.01);
}

TEST(SpringContact, waterThatReachesFarHidesNoneOfTheLaw) {
  const ContactTraction traction = law();
  const std::vector<ReliefClass> relief = {{0.0, 0.5}, {0.3e-9, 0.5}};
  const double stiffness = 1e19;
  const WaterLaw damp(0.3, 0.072, 0.0, 298.15, 18.07e-6, 0.0);
  const auto dry = springBranch(relief, traction, kNoField, WaterLaw(), stiffness);
  const double of_law = strengthFrom(restOf(dry, 0.0), dry);
  for (const double humidity : {0.9, 0.999, 0.99999}) {
    SCOPED_TRACE(humidity);
    const WaterLaw water(humidity, 0.072, 0.0, 298.15, 18.07e-6, 0.0);
    ASSERT_GT(water.gapLimit(), damp.gapLimit());
    const auto branch = springBranch(relief, traction, kNoField, water, stiffness);
    const double strength = strengthFrom(restOf(branch, 0.0), branch);
    EXPECT_NEAR(strength / (of_law + water.pressure()), 1.0, 0.01);
  }
}

TEST(SpringContact, halfOfSoftSurfacesIsPressedWhateverTheStiffness) {
  const ContactTraction traction = law();
  const std::vector<ReliefClass> relief = {{0.0, 0.25}, {2e-9, 0.25}, {3e-9, 0.25}, {5e-9, 0.25}};
  for (const double stiffness : {1e14, 1e15, 3e15}) {
    SCOPED_TRACE(stiffness);
    const auto branch = springBranch(relief, traction, kNoField, WaterLaw(), stiffness);
    EXPECT_EQ(repellingShare(restOf(branch, 0.0), branch, 0.0, relief, traction.range()), 0.5);
  }
}

TEST(SpringContact, flatteningTakesItsEnergyFromTheWork) {
  // two heights, half of the cells each, h apart: sigma = h/2, and springs of k store k sigma^2/2 =
  // U
  const double height = 0.4e-9;
  const double flattening = 0.01;
  const double stiffness = 2.0 * flattening / (0.25 * height * height);
  const auto branch =
      springBranch({{0.0, 0.5}, {height, 0.5}}, law(), kNoField, WaterLaw(), stiffness);
  // all else but the give of the law, some U/(Gamma 27/...) of it: a stiff law would give exactly
  // Gamma - U
  EXPECT_NEAR(-restOf(branch, 0.0)->energy, 0.05 - flattening, 0.1 * flattening);
}

TEST(SpringContact, workIsTheAreaOfTheBranchWhereNothingSnaps) {
  const auto branch = springBranch({{0.0, 0.3}, {0.05e-9, 0.7}}, law(), kNoField, WaterLaw(), 1e20);
  const auto rest = restOf(branch, 0.0);
  double area = 0.0;
  for (auto state = rest; state + 1 != branch.end(); ++state) {
    area += 0.5 * (state->traction + (state + 1)->traction) * ((state + 1)->height - state->height);
  }
  EXPECT_NEAR(area / (branch.back().energy - rest->energy), 1.0, 0.01);
}

TEST(SpringContact, pressureMovesTheRestInwards) {
  const auto branch = springBranch({{0.0, 0.5}, {0.2e-9, 0.5}}, law(), kNoField, WaterLaw(), 5e18);
  EXPECT_LT(restOf(branch, 1e9)->height, restOf(branch, 0.0)->height);
}

TEST(ReliefClasses, keepMeanSharesAndRms) {
  ReliefClasses depths(1.0, 3.0);
  for (const double depth : {1.0, 1.0, 3.0, 3.0}) depths.add(depth);
  const auto classes = depths.classes();
  ASSERT_EQ(classes.size(), 2U);
  EXPECT_EQ(classes[0].depth, 0.0);
  EXPECT_EQ(classes[1].depth, 2.0);
  EXPECT_EQ(classes[1].share, 0.5);
}

}  // namespace
}  // namespace mems_stiction
