/// How far the curve's figures may be off: where the rule tips.

#include "separation/curve_statement.hpp"

#include <gtest/gtest.h>

#include "separation/chosen_constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kWork = 0.05;  // J/m^2

ContactSolution solutionWith(double flattening_ratio, const char* doubt) {
  ContactSolution solution;
  solution.flattening_energy = flattening_ratio * kWork;
  solution.model.doubt = doubt;
  return solution;
}

TEST(CurveStatement, takesTheDoubtOfTheWayOutAndItsError) {
  for (const bool is_conforming : {false, true}) {
    for (const char* doubt : {static_cast<const char*>(nullptr), "it tears"}) {
      ContactSolution solution = solutionWith(3.0, doubt);
      solution.is_conforming = is_conforming;
      const ModelStatement stated = CurveStatement::of(solution, kWork);
      EXPECT_EQ(stated.doubt, doubt);
      const ModelError& sure = is_conforming ? chosen::kSureBondedError : chosen::kSureError;
      const ModelError& doubted = is_conforming ? chosen::kDoubtBondedError : chosen::kDoubtError;
      const ModelError& error = doubt != nullptr ? doubted : sure;
      EXPECT_EQ(stated.error.pull_off, error.pull_off);
      EXPECT_EQ(stated.error.work, error.work);
      EXPECT_FALSE(stated.is_bound_where_bonded);
    }
  }
}

TEST(CurveStatement, thinBodiesAreDoubtedWhereTheyBendBetweenContacts) {
  for (const bool is_near : {false, true}) {
    const double ratio = chosen::kBentTogether * (is_near ? 0.999 : 1.001);
    const ModelStatement stated = CurveStatement::of(solutionWith(ratio, nullptr), kWork, true);
    EXPECT_EQ(stated.doubt != nullptr, is_near);
    EXPECT_EQ(stated.error.pull_off, (is_near ? chosen::kBentError : chosen::kSureError).pull_off);
  }
}

}  // namespace
}  // namespace mems_stiction
