#include "mechanics/transition.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/reference_contacts.hpp"

namespace mems_stiction {
namespace {

constexpr double kPolysiliconModulus = 88.7978e9;
constexpr double kRoundOff = 1e-13;  // closed forms against closed forms

void expectRelative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::fabs(expected));
}

TEST(Maugis, reproducesThePublishedPullOffForces) {
  const double table[][2] = {{0.01, 1.99829}, {0.1, 1.95059}, {0.3, 1.81556}, {0.5, 1.71825},
                             {1.0, 1.60073},  {2.0, 1.53460}, {5.0, 1.50635}};
  for (const auto& row : table)
    EXPECT_NEAR(maugis::pullOffPrefactor(row[0]), row[1], 6e-6);  // five decimals
}

TEST(Maugis, fitStaysWithinItsStatedError) {
  double worst = 0.0;
  for (double log_lambda = -9.0; log_lambda < 7.0; log_lambda += 0.05) {
    const double lambda = std::exp(log_lambda);
    worst = std::max(
        worst,
        std::fabs(maugis::fittedPullOffPrefactor(lambda) / maugis::pullOffPrefactor(lambda) - 1.0));
  }
  EXPECT_LT(worst, 0.017);
  EXPECT_GT(worst, 0.016);  // the header's number, not a looser one
  for (const double lambda :
       {0.1, 0.5, 1.0}) {  // the figure published for these three: 1.2 %, to its last digit
    EXPECT_NEAR(maugis::fittedPullOffPrefactor(lambda) / maugis::pullOffPrefactor(lambda), 1.0,
                0.0125);
  }
}

TEST(Maugis, fitIsThePublishedFormula) {
  for (const double lambda : {1e-3, 0.2, 1.0, 30.0}) {
    const double x = 4.04 * std::pow(lambda, 1.4);
    expectRelative(maugis::fittedPullOffPrefactor(lambda), 1.75 - 0.25 * (x - 1.0) / (x + 1.0),
                   kRoundOff);
  }
}

TEST(Transition, prefactorFallsFromTwoToThreeHalves) {
  EXPECT_DOUBLE_EQ(pullOffPrefactor(0.0), 2.0);
  double previous = 2.0;
  for (double log_tabor = -6.0; log_tabor < 6.0; log_tabor += 0.1) {
    const double prefactor = pullOffPrefactor(std::exp(log_tabor));
    EXPECT_LT(prefactor, previous);
    EXPECT_GT(prefactor, 1.5);
    previous = prefactor;
  }
  EXPECT_NEAR(pullOffPrefactor(1e6), 1.5, 1e-8);  // 0.5/(4.04 lambda^1.4) = 4e-10
}

TEST(Transition, lambdaIsTaborTimes1157) {
  EXPECT_NEAR(maugis::transitionParameter(1.0), 1.157, 5e-4);  // published to four digits
  // second route: lambda of the largest Lennard-Jones stress against Tabor's parameter, in SI
  const double radius = 60e-9;
  const double work_of_adhesion = 35e-3;
  const double distance = 0.21e-9;
  const double stress = 16.0 * work_of_adhesion / (9.0 * std::sqrt(3.0) * distance);
  const double tabor = taborParameter(radius, work_of_adhesion, kPolysiliconModulus, distance);
  expectRelative(maugis::transitionParameter(stress, radius, work_of_adhesion, kPolysiliconModulus),
                 maugis::transitionParameter(tabor), kRoundOff);
}

TEST(Transition, polysiliconAsperitiesAreNotJkr) {
  // w = 50 mJ/m^2, z0 = 0.3 .. 0.165 nm; published to two digits
  const double table[][3] = {{10e-9, 0.05, 0.09}, {100e-9, 0.11, 0.19}, {1e-6, 0.23, 0.41}};
  for (const auto& row : table) {
    EXPECT_NEAR(taborParameter(row[0], 50e-3, kPolysiliconModulus, 0.3e-9), row[1], 0.005);
    EXPECT_NEAR(taborParameter(row[0], 50e-3, kPolysiliconModulus, 0.165e-9), row[2], 0.005);
  }
}

TEST(Transition, taborParameterIsItsFormulaAndScales) {
  const double radius = 3e-8;
  const double w = 0.02;
  const double distance = 0.165e-9;
  const double tabor = taborParameter(radius, w, kPolysiliconModulus, distance);
  expectRelative(
      tabor,
      std::pow(radius * w * w /
                   (kPolysiliconModulus * kPolysiliconModulus * distance * distance * distance),
               1.0 / 3.0),
      kRoundOff);
  expectRelative(taborParameter(8.0 * radius, w, kPolysiliconModulus, distance), 2.0 * tabor,
                 kRoundOff);
  expectRelative(taborParameter(radius, 8.0 * w, kPolysiliconModulus, distance), 4.0 * tabor,
                 kRoundOff);
  expectRelative(taborParameter(radius, w, 8.0 * kPolysiliconModulus, distance), 0.25 * tabor,
                 kRoundOff);
  expectRelative(taborParameter(radius, w, kPolysiliconModulus, 2.0 * distance), 0.5 * tabor,
                 kRoundOff);
  EXPECT_EQ(taborParameter(radius, 0.0, kPolysiliconModulus, distance), 0.0);
}

}  // namespace
}  // namespace mems_stiction
