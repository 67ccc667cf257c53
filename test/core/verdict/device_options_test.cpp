#include "mems_stiction/verdict/device_options.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/surface_forces.hpp"

namespace mems_stiction {
namespace {

constexpr double kUm = 1e-6;

DeviceOptions plate(double travel) {
  DeviceOptions device;
  device.spring_stiffness = 1.0;
  device.travel = travel;
  device.electrode_gap = 2 * kUm;
  device.electrode_area = 1e-8;
  return device;
}

InterfaceOptions bare() {
  InterfaceOptions interface;
  interface.insulator_thickness = 0.0;
  return interface;
}

TEST(ClosingVoltage, isThePullInOfTheReference) {
  EXPECT_NEAR(closingVoltage(plate(2 * kUm), bare()), 5.1741, 1e-4);  // published to five digits
  EXPECT_NEAR(closingVoltage(plate(0.7 * kUm), bare()), 5.1741, 1e-4);
}

TEST(ClosingVoltage, balancesTheSpringWhenTheTravelEndsBeforePullIn) {
  const double voltage = closingVoltage(plate(0.3 * kUm), bare());
  const double pull = 1e-8 * surface_forces::electrostaticPressure(1.7 * kUm, voltage, 0.0, 1.0);
  EXPECT_NEAR(pull, 0.3e-6, 1e-18);  // k travel
  EXPECT_LT(voltage, 5.1741);
}

TEST(ClosingVoltage, joinsWhereTheTravelIsAThirdOfTheElectricalGap) {
  InterfaceOptions insulated;
  insulated.insulator_thickness = 0.39 * kUm;
  insulated.insulator_relative_permittivity = 3.9;
  const double third = 2.1 * kUm / 3.0;
  EXPECT_NEAR(closingVoltage(plate(0.999999 * third), insulated),
              closingVoltage(plate(1.000001 * third), insulated),
              1e-9);  // the largest voltage: flat to first order
}

TEST(ClosingVoltage, takesTheTravelForAGapNotStated) {
  DeviceOptions device = plate(2 * kUm);
  device.electrode_gap = 0.0;
  EXPECT_NEAR(closingVoltage(device, bare()), 5.1741, 1e-4);
}

TEST(ClosingVoltage, isNotANumberWhenNotStated) {
  DeviceOptions device = plate(2 * kUm);
  device.electrode_area = 0.0;
  EXPECT_TRUE(std::isnan(closingVoltage(device, bare())));
  EXPECT_TRUE(std::isnan(closingVoltage(DeviceOptions(), bare())));
}

TEST(DeviceOptions, defaultsStateNothingAndAreAllowed) {
  EXPECT_FALSE(DeviceOptions().isStated());
  EXPECT_TRUE(DeviceOptions().validate().empty());
}

TEST(DeviceOptions, namesEveryMissingPartOfABeam) {
  DeviceOptions device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 300 * kUm;
  const std::vector<std::string> violations = device.validate();
  ASSERT_EQ(violations.size(), 3u);
  EXPECT_NE(violations[0].find("device/beam_thickness"), std::string::npos);
  EXPECT_NE(violations[1].find("device/beam_gap"), std::string::npos);
  EXPECT_NE(violations[2].find("device/beam_modulus"), std::string::npos);
}

/// Sums and products of typed numbers differ from the typed one in their last digit.
TEST(DeviceOptions, takesGeometryThatIsEqualButForRounding) {
  DeviceOptions device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 300e-6;
  device.beam_thickness = device.beam_gap = 2e-6;
  device.beam_modulus = 160e9;
  device.electrode_start = 250e-6;
  device.electrode_length = 50e-6;
  ASSERT_GT(device.electrode_start + device.electrode_length, device.beam_length);
  EXPECT_TRUE(device.validate().empty());
  device.electrode_length *= 1.0 + 1e-6;
  EXPECT_EQ(device.validate().size(), 1U);
  device.electrode_start = device.electrode_length = 0.0;

  device.beam_width = 30e-6;
  device.beam_length = 70e-6;
  device.contact_area = 2.1e-9;
  ASSERT_GT(device.contact_area, device.beam_width * device.beam_length);
  EXPECT_TRUE(device.validate().empty());
  device.contact_area *= 1.0 + 1e-6;
  EXPECT_EQ(device.validate().size(), 1U);
  device.contact_area = 0.0;

  device.electrode_length = 50e-6;
  device.electrode_gap = device.beam_gap * (1.0 - 1e-12);
  EXPECT_TRUE(device.validate().empty());
  device.electrode_gap = device.beam_gap * (1.0 - 1e-6);
  EXPECT_EQ(device.validate().size(), 1U);

  DeviceOptions lands = plate(2 * kUm);
  lands.travel = lands.electrode_gap * (1.0 + 1e-12);
  EXPECT_TRUE(lands.validate().empty());
  lands.travel = lands.electrode_gap * (1.0 + 1e-6);
  EXPECT_EQ(lands.validate().size(), 1U);
}

TEST(DeviceOptions, refusesAnElectrodeAreaBelowABeamAlone) {
  DeviceOptions device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 300 * kUm;
  device.beam_width = 20 * kUm;
  device.beam_thickness = device.beam_gap = 2 * kUm;
  device.beam_modulus = 160e9;
  EXPECT_EQ(whatPullInLacks(device), "device/electrode_length");
  device.electrode_area = 3e-9;
  const std::vector<std::string> violations = device.validate();
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0],
            "device/electrode_area: 3e-09 m^2 is not allowed for a beam without a spring, must be "
            "0: its electrode is "
            "stated by device/electrode_start and device/electrode_length (of the whole "
            "device/beam_width it would be "
            "0.00015 m long)");
  device.spring_stiffness = 1.0;
  device.travel = 1 * kUm;
  EXPECT_TRUE(device.validate().empty()) << "the spring's";
}

TEST(DeviceOptions, refusesNegativeValuesAndATravelBeyondTheElectrode) {
  DeviceOptions device = plate(2.5e-6);
  device.contact_area = -1.0;
  const std::vector<std::string> violations = device.validate();
  ASSERT_EQ(violations.size(), 2u);
  EXPECT_NE(violations[0].find("device/contact_area: -1 m^2"), std::string::npos);
  EXPECT_NE(violations[1].find("device/travel: 2.5e-06 m"), std::string::npos);
}

}  // namespace
}  // namespace mems_stiction
