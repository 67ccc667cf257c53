/// How far the curve's figures may be off: where the rule tips.

#include "separation/curve_statement.hpp"

#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "separation/chosen_constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kWork = 0.05;  // J/m^2

ContactSolution solutionWith(double tabor_parameter, double flattening_ratio) {
  ContactSolution solution;
  solution.asperities.resize(3);
  for (Asperity& asperity : solution.asperities) asperity.tabor_parameter = tabor_parameter;
  solution.flattening_energy = flattening_ratio * kWork;
  return solution;
}

TEST(CurveStatement, brittleContactsMayGrowTogetherAtTwiceTheFlatteningRatio) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  CurveStatement statement;
  for (const auto& [tabor, limit] :
       {std::pair(0.0, 2.0), {0.4, 2.8}, {1.0, 4.0}, {3.0, 4.0}, {infinite, 4.0}, {nan, 2.0}}) {
    for (const bool is_near : {false, true}) {
      const ModelStatement stated = statement.of(solutionWith(tabor, limit * (is_near ? 0.999 : 1.001)), kWork);
      EXPECT_EQ(stated.may_grow_together, is_near) << tabor;
      EXPECT_EQ(stated.error.pull_off, (is_near ? chosen::kNearBondingError : chosen::kSparseError).pull_off);
      EXPECT_EQ(stated.error.work, (is_near ? chosen::kNearBondingError : chosen::kSparseError).work);
    }
  }
}

TEST(CurveStatement, theContactsThatHoldAtThePullOffTell) {
  ContactSolution solution = solutionWith(0.0, 3.9);
  EXPECT_FALSE(CurveStatement().of(solution, kWork).may_grow_together);
  solution.pull_off_contacts.resize(1);
  solution.pull_off_contacts[0].tabor_parameter = 1.0;
  EXPECT_TRUE(CurveStatement().of(solution, kWork).may_grow_together);
}

TEST(CurveStatement, conformingSurfacesHaveAnErrorOfTheirOwn) {
  ContactSolution solution = solutionWith(0.0, 0.1);
  solution.is_conforming = true;
  const ModelStatement stated = CurveStatement().of(solution, kWork);
  EXPECT_TRUE(stated.may_grow_together);
  EXPECT_EQ(stated.error.pull_off, chosen::kConformingError.pull_off);
  EXPECT_EQ(stated.error.work, chosen::kConformingError.work);
  EXPECT_FALSE(stated.is_bound_where_bonded);
}

TEST(CurveStatement, withoutAdhesionNothingGrowsTogether) {
  EXPECT_FALSE(CurveStatement().of(solutionWith(0.0, 0.0), 0.0).may_grow_together);
}

}  // namespace
}  // namespace mems_stiction
