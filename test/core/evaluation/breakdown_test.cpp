/// Voltages over less than nothing stands are named; usual operating points are not.

#include "evaluation/breakdown.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

Options optionsOf(double voltage, double thickness, double permittivity = 3.9) {
  Options options;
  options.load.voltage = voltage;
  options.interface.insulator_thickness = thickness;
  options.interface.insulator_relative_permittivity = permittivity;
  return options;
}

std::string onlyLine(const std::vector<std::string>& lines) {
  EXPECT_EQ(lines.size(), 1u);
  return lines.empty() ? "" : lines.front();
}

TEST(Breakdown, ofTheInsulatorIsTheWholeVoltageOverItsThickness) {
  const std::string line = onlyLine(breakdownWarnings(optionsOf(-20.0, 4e-9), {}, 20e-9));
  EXPECT_NE(
      line.find(
          "load/voltage 20 V over interface/insulator_thickness 4e-09 m is a field of 5 GV/m"),
      std::string::npos)
      << line;
  EXPECT_EQ(line.find(','), std::string::npos);
  EXPECT_TRUE(breakdownWarnings(optionsOf(99.0, 100e-9), {}, 50e-9).empty());
  EXPECT_EQ(breakdownWarnings(optionsOf(101.0, 100e-9), {}, 50e-9).size(), 1u);
}

TEST(Breakdown, ofANarrowGapCountsTheInsulatorByItsPermittivity) {
  // 20 V over 2 nm and 100 nm/25: 3.3 GV/m in the gap, 0.2 GV/m in the insulator
  const std::string line = onlyLine(breakdownWarnings(optionsOf(20.0, 100e-9, 25.0), {}, 2e-9));
  EXPECT_NE(line.find("the mean gap of 2e-09 m is a field of 3.33 GV/m: metals emit"),
            std::string::npos)
      << line;
  EXPECT_TRUE(breakdownWarnings(optionsOf(20.0, 100e-9, 25.0), {}, 3e-9).empty());
}

TEST(Breakdown, ofTheElectrodesIsAskedAtRestAndClosed) {
  DeviceOptions device;
  device.electrode_gap = 3e-6;
  device.travel = 1e-6;
  EXPECT_TRUE(breakdownWarnings(optionsOf(200.0, 1e-6), device, 20e-9).empty());
  const std::string closed = onlyLine(breakdownWarnings(optionsOf(300.0, 1e-6), device, 20e-9));
  EXPECT_NE(closed.find("the electrodes' gap when closed of 2e-06 m"), std::string::npos) << closed;
  EXPECT_EQ(breakdownWarnings(optionsOf(400.0, 1e-6), device, 20e-9).size(), 2u);

  device.beam_type = BeamType::kCantilever;  // which comes down by its gap, whatever the travel
  device.beam_gap = 2e-6;
  const std::string of_beam = onlyLine(breakdownWarnings(optionsOf(200.0, 1e-6), device, 20e-9));
  EXPECT_NE(of_beam.find("the electrodes' gap when closed of 1e-06 m"), std::string::npos)
      << of_beam;
}

TEST(Breakdown, ofAContactPotentialCountsWithTheVoltages) {
  Options options = optionsOf(-3.0, 4e-9);
  EXPECT_TRUE(breakdownWarnings(options, {}, 20e-9).empty());
  options.load.contact_potential = 2.0;
  const std::string both = onlyLine(breakdownWarnings(options, {}, 20e-9));
  EXPECT_EQ(both.find("load/voltage 3 V and load/contact_potential 2 V over "
                      "interface/insulator_thickness 4e-09 m is a field of 1.25 GV/m"),
            0u)
      << both;
  options.load.voltage = 0.0;
  options.load.contact_potential = -5.0;
  const std::string alone = onlyLine(breakdownWarnings(options, {}, 20e-9));
  EXPECT_EQ(alone.find("load/contact_potential 5 V over "), 0u) << alone;
}

TEST(Breakdown, needsAVoltage) {
  EXPECT_TRUE(breakdownWarnings(optionsOf(0.0, 0.0), {}, 1e-9).empty());
  EXPECT_TRUE(breakdownWarnings(optionsOf(5.0, 100e-9), {}, std::nan("")).empty())
      << "of bonded surfaces";
}

}  // namespace
}  // namespace mems_stiction
