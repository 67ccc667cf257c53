#include "mechanics/jkr.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/reference_contacts.hpp"

namespace mems_stiction {
namespace {

constexpr double kPolysiliconModulus = 88.7978e9;
// Closed forms against closed forms: a few operations of round-off.
constexpr double kRoundOff = 1e-13;

void expectRelative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::fabs(expected));
}

struct Sphere {
  double radius;
  double work_of_adhesion;
  double contact_modulus;

  double k() const { return 4.0 / 3.0 * contact_modulus; }
  // Maugis' units
  double forceUnit() const { return kPi * work_of_adhesion * radius; }
  double lengthUnit() const { return std::cbrt(kPi * work_of_adhesion * radius * radius / k()); }

  double load(double a) const { return jkr::load(a, work_of_adhesion, radius, contact_modulus); }
  double approach(double a) const {
    return jkr::approach(a, work_of_adhesion, radius, contact_modulus);
  }
  double energy(double a) const {
    return jkr::energy(a, work_of_adhesion, radius, contact_modulus);
  }
  double contactRadius(double force) const {
    return jkr::equilibriumContactRadius(force, work_of_adhesion, radius, contact_modulus);
  }
};

class JkrSphere : public testing::TestWithParam<Sphere> {};

// From a hard nanometre asperity to a soft millimetre lens; radius, work of adhesion and modulus
// are nowhere near one.
INSTANTIATE_TEST_SUITE_P(Scales, JkrSphere,
                         testing::Values(Sphere{1e-6, 50e-3, kPolysiliconModulus},
                                         Sphere{100e-9, 10e-3, kPolysiliconModulus},
                                         Sphere{8e-9, 0.3, 400e9}, Sphere{5e-3, 27e-3, 0.7e6}));

TEST_P(JkrSphere, restsUnderNoLoadOnMaugisContactRadius) {
  const Sphere& sphere = GetParam();
  EXPECT_NEAR(sphere.contactRadius(0.0) / sphere.lengthUnit(), 1.817121, 5e-7);  // published digits
}

TEST_P(JkrSphere, loadInvertsTheEquilibriumContactRadius) {
  const Sphere& sphere = GetParam();
  for (const double force : {-1.4, -0.3, 0.7, 4.0, 300.0}) {
    const double load = force * sphere.forceUnit();
    // P(a) is a difference of terms that are up to 10 times larger
    expectRelative(sphere.load(sphere.contactRadius(load)), load, 10.0 * kRoundOff);
  }
}

TEST_P(JkrSphere, apparentLoadSolvesTheQuadraticOfJkr) {
  const Sphere& sphere = GetParam();
  // second route: (P1 - P)^2 = 6 pi w R P1
  for (const double force : {-1.2, 0.0, 2.0, 50.0}) {
    const double load = force * sphere.forceUnit();
    const double apparent = jkr::apparentLoad(load, sphere.work_of_adhesion, sphere.radius);
    expectRelative((apparent - load) * (apparent - load), 6.0 * sphere.forceUnit() * apparent,
                   kRoundOff);
    expectRelative(jkr::apparentLoadOfContact(sphere.contactRadius(load), sphere.radius,
                                              sphere.contact_modulus),
                   apparent, kRoundOff);
  }
}

TEST_P(JkrSphere, loadIsTheDerivativeOfTheEnergyByTheApproach) {
  const Sphere& sphere = GetParam();
  for (const double a_in_units : {0.9, 1.3, 2.0, 5.0}) {
    const double a = a_in_units * sphere.lengthUnit();
    const double step = 1e-4 * a;
    const double slope = (sphere.energy(a + step) - sphere.energy(a - step)) /
                         (sphere.approach(a + step) - sphere.approach(a - step));
    // central difference: truncation of order (step/a)^2 = 1e-8, times the curvature's factor of
    // about 10
    EXPECT_NEAR(slope / sphere.forceUnit(), sphere.load(a) / sphere.forceUnit(),
                1e-7 * (1.0 + std::fabs(sphere.load(a)) / sphere.forceUnit()));
  }
}

TEST_P(JkrSphere, approachesHertzAsTheWorkOfAdhesionVanishes) {
  const Sphere& sphere = GetParam();
  const double load = 20.0 * sphere.forceUnit();
  const double hertz_radius = hertz::contactRadius(load, sphere.radius, sphere.contact_modulus);
  EXPECT_DOUBLE_EQ(jkr::equilibriumContactRadius(load, 0.0, sphere.radius, sphere.contact_modulus),
                   hertz_radius);
  EXPECT_DOUBLE_EQ(jkr::apparentLoad(load, 0.0, sphere.radius), load);
  EXPECT_DOUBLE_EQ(jkr::approach(hertz_radius, 0.0, sphere.radius, sphere.contact_modulus),
                   hertz::approach(load, sphere.radius, sphere.contact_modulus));
  // w down by 10^6: P1 - P = sqrt(6 pi w R P) falls by 10^3, to sqrt(6/20) 10^-3 of P, a third of
  // it in the radius
  const double nearly = jkr::equilibriumContactRadius(load, 1e-6 * sphere.work_of_adhesion,
                                                      sphere.radius, sphere.contact_modulus);
  EXPECT_GT(nearly, hertz_radius);
  EXPECT_NEAR(nearly / hertz_radius - 1.0, std::sqrt(0.3) * 1e-3 / 3.0, 2e-6);
}

TEST_P(JkrSphere, hasNoEquilibriumBelowThePullOffForce) {
  const Sphere& sphere = GetParam();
  const double pull_off = jkr::pullOffForce(sphere.work_of_adhesion, sphere.radius);
  EXPECT_TRUE(std::isfinite(sphere.contactRadius(-0.999999 * pull_off)));
  EXPECT_TRUE(std::isnan(sphere.contactRadius(-1.000001 * pull_off)));
}

TEST_P(JkrSphere, contactScalesWithRadiusTwoThirdsAndModulusMinusOneThird) {
  const Sphere& sphere = GetParam();
  const double at_rest = sphere.contactRadius(0.0);
  const Sphere larger{8.0 * sphere.radius, sphere.work_of_adhesion, sphere.contact_modulus};
  const Sphere stiffer{sphere.radius, sphere.work_of_adhesion, 8.0 * sphere.contact_modulus};
  const Sphere stickier{sphere.radius, 8.0 * sphere.work_of_adhesion, sphere.contact_modulus};
  expectRelative(larger.contactRadius(0.0), 4.0 * at_rest, kRoundOff);
  expectRelative(stiffer.contactRadius(0.0), 0.5 * at_rest, kRoundOff);
  expectRelative(stickier.contactRadius(0.0), 2.0 * at_rest, kRoundOff);
}

}  // namespace
}  // namespace mems_stiction
