#include "paper/formulation_share.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr double kPlastic = 2.0;
constexpr double kElastic = 0.3;

FormulationShare shareOf(double lower_hardness, double upper_hardness, Formulation formulation,
                         Deformation deformation = Deformation::kThreeRegimes) {
  Material lower;
  Material upper;
  lower.hardness = lower_hardness;
  upper.hardness = upper_hardness;
  return {lower, upper, 0.9, formulation, deformation};
}

TEST(FormulationShare, jumpsInPrintAtEqualHardness) {
  // P/w = 1/2 +- 1/(4 (1 + |ln(H2/H1)/ln a|))
  EXPECT_DOUBLE_EQ(shareOf(12e9, 12e9, Formulation::kPrinted).lower(kPlastic), 0.5);
  EXPECT_DOUBLE_EQ(shareOf(12e9, 12e9, Formulation::kPrinted).upper(kPlastic), 0.5);
  EXPECT_NEAR(shareOf(10e9, 10e9 * 1.000001, Formulation::kPrinted).lower(kPlastic), 0.75, 1e-5);
  EXPECT_NEAR(shareOf(10e9 * 1.000001, 10e9, Formulation::kPrinted).lower(kPlastic), 0.25, 1e-5);
  EXPECT_NEAR(shareOf(10.5e9, 10e9, Formulation::kPrinted).lower(kPlastic),
              0.5 - 0.25 / (1.0 + std::log(1.05) / std::log(1 / 0.9)), 1e-12);
}

TEST(FormulationShare, takesNoHeedOfTheRegimeInPrintedThirteen) {
  EXPECT_EQ(shareOf(1e9, 12e9, Formulation::kPrinted).lower(kElastic), 1.0);
  EXPECT_EQ(shareOf(12e9, 1e9, Formulation::kPrinted).upper(kElastic), 1.0);
  EXPECT_EQ(shareOf(1e9, 12e9, Formulation::kPaper).lower(kElastic), 0.0);
  EXPECT_EQ(shareOf(10e9, 10.5e9, Formulation::kPrinted).lower(kElastic), 0.0);  // (12) does
  EXPECT_EQ(shareOf(1e9, 12e9, Formulation::kPrinted, Deformation::kElastic).lower(0.0), 0.0);
}

}  // namespace
}  // namespace mems_stiction
