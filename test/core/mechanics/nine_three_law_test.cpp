/// The law of adhesion and that of the field against their own integrals and derivatives, limits
/// and scaling, in SI.

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/surface_forces.hpp"
#include "mechanics/traction_law.hpp"
#include "numeric/constants.hpp"
#include "numeric/packet.hpp"
#include "support/reference_contacts.hpp"

namespace mems_stiction {
namespace {

constexpr double kWork = 0.05;
constexpr double kHamaker = 65e-21;
constexpr double kRoundOff = 1e-13;

AdhesionLaw silica() { return AdhesionLaw(kWork, AdhesionLaw::rangeOf(kWork, kHamaker)); }

TEST(AdhesionLaw, VanishesAtItsRangeWhereItHasTheWorkOfAdhesion) {
  const AdhesionLaw law = silica();
  EXPECT_EQ(law.traction(1.0), 0.0);
  EXPECT_NEAR(law.energy(1.0) / kWork, 1.0, kRoundOff);
  EXPECT_NEAR(law.range(), 1.608e-10, 1e-13);  // by hand: sqrt(65e-21/(16 pi 0.05))
}

TEST(AdhesionLaw, FallsOffAsHamakersPlates) {
  const AdhesionLaw law = silica();
  const double gap = 300.0 * law.range();  // (z0/g)^6 is below round-off
  EXPECT_NEAR(law.traction(law.range() / gap) / surface_forces::vanDerWaalsPressure(gap, kHamaker),
              1.0, 1e-12);
  EXPECT_NEAR(law.energy(law.range() / gap) / surface_forces::vanDerWaalsEnergy(gap, kHamaker), 1.0,
              1e-12);
}

TEST(AdhesionLaw, IsStrongestAtTheSixthRootOfThree) {
  const AdhesionLaw law = silica();
  const double x = std::pow(3.0, -1.0 / 6.0);
  EXPECT_NEAR(law.slope(x) * law.range() / law.stress(), 0.0, kRoundOff);
  EXPECT_NEAR(law.traction(x) / law.strength(), 1.0, kRoundOff);
  EXPECT_NEAR(law.strength() * law.range() / kWork, 16.0 / (9.0 * std::sqrt(3.0)), kRoundOff);
}

TEST(AdhesionLaw, SlopeCurvatureAndEnergyBelongToTheTraction) {
  const AdhesionLaw law = silica();
  const double z0 = law.range();
  for (const double gap : {0.6, 0.9, 1.1, 1.5, 3.0, 20.0}) {
    const double h = 1e-4 * gap * z0;  // central differences: h^2/g^2 times some tens
    const double below = z0 / (gap * z0 - h);
    const double above = z0 / (gap * z0 + h);
    const double here = 1.0 / gap;
    EXPECT_NEAR((law.energy(below) - law.energy(above)) / (2.0 * h) / law.traction(here), 1.0, 1e-5)
        << gap;
    EXPECT_NEAR((law.traction(above) - law.traction(below)) / (2.0 * h) / law.slope(here), 1.0,
                1e-5)
        << gap;
    EXPECT_NEAR((law.slope(above) - law.slope(below)) / (2.0 * h) / law.curvature(here), 1.0, 1e-5)
        << gap;
  }
}

TEST(AdhesionLaw, ScalesWithWorkAndRange) {
  const AdhesionLaw one(0.05, 0.2e-9);
  const AdhesionLaw other(0.15, 1.4e-9);
  for (const double x : {0.3, 0.8, 1.3}) {
    EXPECT_NEAR(other.traction(x) / one.traction(x), 3.0 / 7.0, kRoundOff);
    EXPECT_NEAR(other.energy(x) / one.energy(x), 3.0, kRoundOff);
    EXPECT_NEAR(other.slope(x) / one.slope(x), 3.0 / 49.0, kRoundOff);
  }
}

TEST(AdhesionLaw, TakesSeveralGapsAtOnceWithTheSameBits) {
  const AdhesionLaw law = silica();
  const double x[Packet::kCount] = {0.2, 0.7, 1.0, 1.9};
  double traction[Packet::kCount];
  law.traction(Packet::load(x)).store(traction);
  for (std::size_t i = 0; i < Packet::kCount; ++i) EXPECT_EQ(traction[i], law.traction(x[i]));
}

TEST(AdhesionLaw, WithoutWorkNothingAttracts) {
  const AdhesionLaw law(0.0, 0.2e-9);
  EXPECT_EQ(law.strength(), 0.0);
  EXPECT_EQ(law.energy(0.5), 0.0);
}

TEST(FieldLaw, IsThePressureOfPlatesOverAnInsulator) {
  const FieldLaw field(10.0, 100e-9, 3.9);
  EXPECT_TRUE(field.isOn());
  const double gap = 40e-9;
  EXPECT_NEAR(field.pressure(gap) / surface_forces::electrostaticPressure(gap, 10.0, 100e-9, 3.9),
              1.0, kRoundOff);
  EXPECT_NEAR(
      field.pressure(gap) / (0.5 * kVacuumPermittivity * std::pow(10.0 / (gap + 100e-9 / 3.9), 2)),
      1.0, kRoundOff);
  EXPECT_NEAR(field.factor(2.0) / field.squaredDistance(gap) / (2.0 * field.pressure(gap)), 1.0,
              kRoundOff);
}

TEST(FieldLaw, SlopeAndEnergyBelongToThePressure) {
  const FieldLaw field(10.0, 100e-9, 3.9);
  for (const double gap : {0.0, 5e-9, 200e-9}) {
    const double h = 1e-12;  // of distances of 26 nm and more: truncation 1e-9
    EXPECT_NEAR((field.energy(gap - h) - field.energy(gap + h)) / (2.0 * h) / field.pressure(gap),
                1.0, 1e-6)
        << gap;
    EXPECT_NEAR((field.pressure(gap + h) - field.pressure(gap - h)) / (2.0 * h) / field.slope(gap),
                1.0, 1e-6)
        << gap;
  }
}

TEST(FieldLaw, WithoutVoltageNothingAttracts) {
  const FieldLaw field(0.0, 100e-9, 3.9);
  EXPECT_FALSE(field.isOn());
  EXPECT_EQ(field.pressure(1e-9), 0.0);
}

}  // namespace
}  // namespace mems_stiction
