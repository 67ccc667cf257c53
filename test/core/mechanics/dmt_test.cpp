#include "support/reference_contacts.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/jkr.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 88.7978e9;
constexpr double kRadius = 37e-9;
constexpr double kWorkOfAdhesion = 18e-3;
// Closed forms against closed forms: a few operations of round-off.
constexpr double kRoundOff = 1e-13;

void expectRelative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::fabs(expected));
}

TEST(Dmt, reproducesPolysiliconAsperitiesInSi) {
  expectRelative(dmt::pullOffForce(50e-3, 1e-6), 314.159e-9, 5e-6);   // published to six digits
  expectRelative(dmt::pullOffForce(10e-3, 100e-9), 6.2832e-9, 1e-5);  // to five
}

TEST(Dmt, passesThroughTheStatesInMaugisUnits) {
  const double k = 4.0 / 3.0 * kModulus;
  const double force_unit = kPi * kWorkOfAdhesion * kRadius;
  const double length_unit = std::cbrt(kPi * kWorkOfAdhesion * kRadius * kRadius / k);
  const double approach_unit =
      std::cbrt(kPi * kPi * kWorkOfAdhesion * kWorkOfAdhesion * kRadius / (k * k));
  for (const double a : {0.0, 0.5, 1.26, 2.0, 5.0}) {
    EXPECT_NEAR(dmt::load(a * length_unit, kWorkOfAdhesion, kRadius, kModulus) / force_unit,
                a * a * a - 2.0, kRoundOff * (2.0 + a * a * a));
    EXPECT_NEAR(dmt::approach(a * length_unit, kRadius) / approach_unit, a * a, kRoundOff * a * a);
  }
}

TEST(Dmt, loadInvertsTheEquilibriumContactRadius) {
  for (const double factor : {-0.9, 0.1, 3.0, 1e3}) {
    const double load = factor * dmt::pullOffForce(kWorkOfAdhesion, kRadius);
    const double a = dmt::equilibriumContactRadius(load, kWorkOfAdhesion, kRadius, kModulus);
    expectRelative(dmt::load(a, kWorkOfAdhesion, kRadius, kModulus), load,
                   20.0 * kRoundOff);  // small differences
  }
}

TEST(Dmt, isHertzUnderALoadLargerByThePullOffForce) {
  const double load = 55e-9;
  const double apparent = load + 2.0 * kPi * kWorkOfAdhesion * kRadius;
  expectRelative(dmt::equilibriumContactRadius(load, kWorkOfAdhesion, kRadius, kModulus),
                 hertz::contactRadius(apparent, kRadius, kModulus), kRoundOff);
  EXPECT_DOUBLE_EQ(dmt::equilibriumContactRadius(load, 0.0, kRadius, kModulus),
                   hertz::contactRadius(load, kRadius, kModulus));
}

TEST(Dmt, stiffnessIsThatOfHertz) {
  const double a = 4e-9;
  const double step = 1e-5 * a;
  const double slope = (dmt::load(a + step, kWorkOfAdhesion, kRadius, kModulus) -
                        dmt::load(a - step, kWorkOfAdhesion, kRadius, kModulus)) /
                       (dmt::approach(a + step, kRadius) - dmt::approach(a - step, kRadius));
  expectRelative(slope, 2.0 * kModulus * a,
                 1e-8);  // dP/dd = 2 E a; central difference, truncation 1e-10
}

TEST(Dmt, sticksMoreThanJkrByFourThirds) {
  expectRelative(dmt::pullOffForce(kWorkOfAdhesion, kRadius),
                 4.0 / 3.0 * jkr::pullOffForce(kWorkOfAdhesion, kRadius), kRoundOff);
}

TEST(Dmt, hasNoEquilibriumBelowThePullOffForce) {
  const double pull_off = dmt::pullOffForce(kWorkOfAdhesion, kRadius);
  EXPECT_EQ(dmt::equilibriumContactRadius(-pull_off, kWorkOfAdhesion, kRadius, kModulus), 0.0);
  EXPECT_TRUE(std::isnan(
      dmt::equilibriumContactRadius(-1.000001 * pull_off, kWorkOfAdhesion, kRadius, kModulus)));
}

}  // namespace
}  // namespace mems_stiction
