#include "support/reference_contacts.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

// A polysilicon asperity: nothing here is near one.
constexpr double kRadius = 2.3e-6;
constexpr double kModulus = 88.7978e9;
constexpr double kLoad = 3.7e-6;
// Closed forms against closed forms: a few operations of round-off.
constexpr double kRoundOff = 1e-14;

void expectRelative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::fabs(expected));
}

TEST(Hertz, reproducesTheReferenceSphere) {
  // E* = 5, R = 4, F = 7: computed to all digits of a double
  expectRelative(hertz::approach(7.0, 4.0, 5.0), 0.6507879989531481, kRoundOff);
  expectRelative(hertz::contactRadius(7.0, 4.0, 5.0), 1.6134286460245437, kRoundOff);
  expectRelative(hertz::maximumPressure(7.0, 4.0, 5.0), 1.2839257217043503, kRoundOff);
}

TEST(Hertz, scalesFromTheReferenceToSi) {
  // lengths x L, forces x P, moduli x P/L^2 leave the equations as they are
  const double length = 1e-6 / 4.0;
  const double force = 3e-6 / 7.0;
  const double modulus = 5.0 * force / (length * length);
  expectRelative(hertz::contactRadius(7.0 * force, 4.0 * length, modulus),
                 1.6134286460245437 * length, kRoundOff);
  expectRelative(hertz::approach(7.0 * force, 4.0 * length, modulus), 0.6507879989531481 * length,
                 kRoundOff);
  expectRelative(hertz::maximumPressure(7.0 * force, 4.0 * length, modulus),
                 1.2839257217043503 * force / (length * length), kRoundOff);
}

TEST(Hertz, loadInvertsApproachAndContactRadius) {
  expectRelative(hertz::load(hertz::approach(kLoad, kRadius, kModulus), kRadius, kModulus), kLoad,
                 kRoundOff);
  expectRelative(
      hertz::loadOfContact(hertz::contactRadius(kLoad, kRadius, kModulus), kRadius, kModulus),
      kLoad, kRoundOff);
}

TEST(Hertz, maximumPressureIsThreeHalvesOfTheMean) {
  const double contact_radius = hertz::contactRadius(kLoad, kRadius, kModulus);
  expectRelative(hertz::maximumPressure(kLoad, kRadius, kModulus),
                 1.5 * kLoad / (kPi * contact_radius * contact_radius), kRoundOff);
}

TEST(Hertz, pressureIntegratesToTheLoad) {
  const double contact_radius = hertz::contactRadius(kLoad, kRadius, kModulus);
  const int rings = 20000;
  double load = 0.0;
  for (int ring = 0; ring < rings; ++ring) {
    const double distance = (ring + 0.5) / rings * contact_radius;
    load += hertz::pressure(distance, kLoad, kRadius, kModulus) * 2.0 * kPi * distance *
            contact_radius / rings;
  }
  // midpoint rule with a root at the edge: order 3/2 in the ring's width, 20000^-1.5 = 4e-7
  expectRelative(load, kLoad, 1e-6);
  EXPECT_EQ(hertz::pressure(contact_radius * 1.0001, kLoad, kRadius, kModulus), 0.0);
}

TEST(Hertz, loadIsTheDerivativeOfTheEnergy) {
  const double approach = hertz::approach(kLoad, kRadius, kModulus);
  const double step = 1e-5 * approach;
  const double difference = (hertz::energy(approach + step, kRadius, kModulus) -
                             hertz::energy(approach - step, kRadius, kModulus)) /
                            (2.0 * step);
  // central difference: truncation 1e-10, round-off 1e-16/1e-5
  expectRelative(difference, kLoad, 1e-9);
}

TEST(Hertz, contactGrowsWithTheCubeRootOfLoadAndRadius) {
  const double contact_radius = hertz::contactRadius(kLoad, kRadius, kModulus);
  expectRelative(hertz::contactRadius(8.0 * kLoad, kRadius, kModulus), 2.0 * contact_radius,
                 kRoundOff);
  expectRelative(hertz::contactRadius(kLoad, 8.0 * kRadius, kModulus), 2.0 * contact_radius,
                 kRoundOff);
  expectRelative(hertz::contactRadius(kLoad, kRadius, 8.0 * kModulus), 0.5 * contact_radius,
                 kRoundOff);
}

TEST(Hertz, hasNoContactWithoutLoad) {
  for (const double load : {0.0, -kLoad}) {
    EXPECT_EQ(hertz::contactRadius(load, kRadius, kModulus), 0.0);
    EXPECT_EQ(hertz::approach(load, kRadius, kModulus), 0.0);
    EXPECT_EQ(hertz::maximumPressure(load, kRadius, kModulus), 0.0);
    EXPECT_EQ(hertz::pressure(0.0, load, kRadius, kModulus), 0.0);
  }
  EXPECT_EQ(hertz::load(-1e-9, kRadius, kModulus), 0.0);
}

}  // namespace
}  // namespace mems_stiction
