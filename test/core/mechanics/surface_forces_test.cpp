#include "mechanics/surface_forces.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/reference_contacts.hpp"

namespace mems_stiction {
namespace {

using namespace surface_forces;

constexpr double kHamaker = 65e-21;
constexpr double kGap = 10e-9;
constexpr double kRoundOff = 1e-13;  // closed forms against closed forms
constexpr double kCentralDifference =
    1e-8;  // step 1e-5 of the gap: truncation a few 1e-10, round-off 1e-11

void expectRelative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::fabs(expected));
}

template <typename Function>
double minusSlope(Function function, double gap) {
  const double step = 1e-5 * gap;
  return -(function(gap + step) - function(gap - step)) / (2.0 * step);
}

TEST(VanDerWaals, reproducesThePlatesOfTheReference) {
  expectRelative(vanDerWaalsPressure(kGap, kHamaker), 3.448e3, 2e-4);  // published to four digits
  expectRelative(vanDerWaalsEnergy(kGap, kHamaker), 17.24e-6, 3e-4);
}

TEST(VanDerWaals, pressureIsMinusTheDerivativeOfTheEnergy) {
  expectRelative(minusSlope([](double gap) { return vanDerWaalsEnergy(gap, kHamaker); }, kGap),
                 vanDerWaalsPressure(kGap, kHamaker), kCentralDifference);
}

TEST(VanDerWaals, fallsWithTheCubeOfTheGap) {
  expectRelative(vanDerWaalsPressure(2.0 * kGap, kHamaker),
                 vanDerWaalsPressure(kGap, kHamaker) / 8.0, kRoundOff);
}

TEST(Electrostatic, reproducesTheElectrodesOfTheReference) {
  expectRelative(electrostaticPressure(100e-9, 10.0, 0.0, 1.0), 44.271e3,
                 2e-5);  // published to five digits
  expectRelative(electrostaticPressure(0.0, 10.0, 100e-9, 3.9), 673.36e3, 2e-5);
}

TEST(Electrostatic, insulatorCountsAsAGapThinnerByItsPermittivity) {
  expectRelative(electrostaticPressure(40e-9, 7.0, 78e-9, 3.9),
                 electrostaticPressure(60e-9, 7.0, 0.0, 1.0), kRoundOff);
  EXPECT_EQ(electrostaticPressure(-5e-9, 7.0, 78e-9, 3.9),
            electrostaticPressure(0.0, 7.0, 78e-9, 3.9));
}

TEST(Electrostatic, isMinusTheDerivativeOfTheFieldEnergyAtFixedVoltage) {
  // co-energy eps0 U^2/(2 (d + t/eps_r)) per area
  const auto coEnergy = [](double gap) {
    return 0.5 * kVacuumPermittivity * 49.0 / (gap + 78e-9 / 3.9);
  };
  expectRelative(minusSlope(coEnergy, 40e-9), electrostaticPressure(40e-9, 7.0, 78e-9, 3.9),
                 kCentralDifference);
}

TEST(Electrostatic, growsWithTheSquareOfTheVoltageEitherSign) {
  const double pressure = electrostaticPressure(30e-9, 5.0, 20e-9, 3.9);
  expectRelative(electrostaticPressure(30e-9, 15.0, 20e-9, 3.9), 9.0 * pressure, kRoundOff);
  EXPECT_EQ(electrostaticPressure(30e-9, -5.0, 20e-9, 3.9), pressure);
  EXPECT_EQ(electrostaticPressure(0.0, 0.0, 0.0, 1.0), 0.0);
}

TEST(Electrostatic, bareContactIsAShortCircuit) {
  EXPECT_TRUE(std::isinf(electrostaticPressure(0.0, 5.0, 0.0, 1.0)));
}

TEST(PullIn, scalesWithGapSpringAndArea) {
  const double voltage = pullInVoltage(1.3, 2.2e-6, 3e-8);
  expectRelative(pullInVoltage(1.3, 4.0 * 2.2e-6, 3e-8), 8.0 * voltage, kRoundOff);
  expectRelative(pullInVoltage(4.0 * 1.3, 2.2e-6, 3e-8), 2.0 * voltage, kRoundOff);
  expectRelative(pullInVoltage(1.3, 2.2e-6, 4.0 * 3e-8), 0.5 * voltage, kRoundOff);
}

}  // namespace
}  // namespace mems_stiction
