/// How far the curve's figures may be off: where the rule tips.

#include "separation/curve_statement.hpp"

#include <gtest/gtest.h>

#include "separation/chosen_constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kWork = 0.05;  // J/m^2

ContactSolution solutionWith(double flattening_ratio, const char* doubt,
                             bool is_conforming = false) {
  ContactSolution solution;
  solution.is_conforming = is_conforming;
  solution.flattening_energy = flattening_ratio * kWork;
  solution.model.doubt = doubt;
  return solution;
}

TEST(CurveStatement, takesTheDoubtOfTheWayOutAndItsError) {
  for (const char* doubt : {static_cast<const char*>(nullptr), "it tears"}) {
    const ModelError& error = doubt != nullptr ? chosen::kDoubtError : chosen::kSureError;
    const ModelStatement stated = CurveStatement::of(solutionWith(1.0, doubt), kWork);
    EXPECT_EQ(stated.doubt, doubt);
    EXPECT_EQ(stated.error.pull_off, error.pull_off);
    EXPECT_EQ(stated.error.work, error.work);
    EXPECT_FALSE(stated.is_bound_where_bonded);
    // contacts far from bonding: 64 to the power of a sixth is 2
    const ModelStatement apart = CurveStatement::of(solutionWith(64.0, doubt), kWork);
    EXPECT_NEAR(apart.error.pull_off, 0.5 * error.pull_off, 1e-12);
    EXPECT_NEAR(apart.error.work, 0.5 * error.work, 1e-12);
  }
}

TEST(CurveStatement, bondedSurfacesHaveAnErrorOfTheirOwn) {
  for (const double ratio : {0.0, 0.5}) {
    const ModelStatement stated = CurveStatement::of(solutionWith(ratio, "bonded", true), kWork);
    EXPECT_EQ(stated.error.pull_off, chosen::kBondedError.pull_off) << ratio;
    EXPECT_EQ(stated.error.work, chosen::kBondedError.work) << ratio;
  }
}

TEST(CurveStatement, doubtsContactsWhereBondedSurfacesHaveLessEnergy) {
  for (const double ratio : {0.3, 0.999, 1.0, 3.0}) {
    const ModelStatement contacts = CurveStatement::of(solutionWith(ratio, nullptr), kWork);
    EXPECT_EQ(contacts.doubt != nullptr, ratio < 1.0) << ratio;
    EXPECT_EQ(CurveStatement::of(solutionWith(ratio, nullptr, true), kWork).doubt, nullptr)
        << ratio;
  }
  EXPECT_EQ(CurveStatement::of(solutionWith(0.3, nullptr), kWork).error.pull_off,
            chosen::kDoubtError.pull_off);
}

TEST(CurveStatement, statesAnErrorWhereNothingSticks) {
  EXPECT_EQ(CurveStatement::of(solutionWith(3.0, nullptr), 0.0).error.pull_off,
            chosen::kSureError.pull_off);
}

TEST(CurveStatement, thinBodiesAreDoubtedHoweverRoughTheyAre) {
  for (const double ratio : {0.3, 3.0, 300.0}) {
    const ModelStatement stated = CurveStatement::of(solutionWith(ratio, nullptr), kWork, true);
    EXPECT_NE(stated.doubt, nullptr) << ratio;
    EXPECT_EQ(stated.error.pull_off, chosen::kDoubtError.pull_off) << ratio;
  }
}

}  // namespace
}  // namespace mems_stiction
