#include "evaluation/breakdown.hpp"

#include <cmath>

#include "errors/short_number.hpp"
#include "mechanics/surface_forces.hpp"

namespace mems_stiction {
namespace {

constexpr double kInsulatorStrength = 1e9;     // [V/m]
constexpr double kNarrowGapStrength = 3e9;     // [V/m]
constexpr double kWideGapStrength = 0.11e9;    // [V/m]
constexpr double kNarrowestMeasured = 0.5e-6;  // [m]

std::string sentence(const LoadOptions& load, const std::string& over, double field,
                     double strength, const std::string& what) {
  return fieldSources(load) + " over " + over + " is a field of " + shortNumber(field * 1e-9) +
         " GV/m: " + what + " from about " + shortNumber(strength * 1e-9) + " GV/m on";
}

}  // namespace

std::string fieldSources(const LoadOptions& load) {
  std::string name;
  if (load.voltage != 0.0) name = "load/voltage " + shortNumber(std::abs(load.voltage)) + " V";
  if (load.contact_potential == 0.0) return name;
  return name + (name.empty() ? "" : " and ") + "load/contact_potential " +
         shortNumber(std::abs(load.contact_potential)) + " V";
}

std::vector<std::string> breakdownWarnings(const Options& options, const DeviceOptions& device,
                                           double mean_gap) {
  std::vector<std::string> lines;
  const LoadOptions& load = options.load;
  const double voltage = load.fieldVoltage();
  if (voltage == 0.0) return lines;
  const double thickness = options.interface.insulator_thickness;
  const double permittivity = options.interface.insulator_relative_permittivity;
  const double in_contact =
      surface_forces::gapField(0.0, voltage, thickness, permittivity) / permittivity;
  if (in_contact > kInsulatorStrength) {
    lines.push_back(sentence(load, "interface/insulator_thickness " + shortNumber(thickness) + " m",
                             in_contact, kInsulatorStrength, "thermal SiO2 breaks down"));
  }
  const auto check = [&](const std::string& name, double gap) {
    const double field = surface_forces::gapField(gap, voltage, thickness, permittivity);
    const bool is_narrow = gap < kNarrowestMeasured;
    const double strength = is_narrow ? kNarrowGapStrength : kWideGapStrength;
    if (!(gap > 0.0 && field > strength)) return;
    lines.push_back(sentence(load, name + " of " + shortNumber(gap) + " m", field, strength,
                             is_narrow ? "metals emit electrons" : "gaps in air break down"));
  };
  check("the mean gap", mean_gap);
  const bool is_beam = device.hasBeam() && !device.hasSpring();
  const double travel = is_beam ? device.beam_gap : device.travel;
  const double rest_gap = device.electrode_gap > 0.0 ? device.electrode_gap : travel;
  check("the electrodes' gap at rest", rest_gap);
  check("the electrodes' gap when closed", rest_gap - travel);
  return lines;
}

}  // namespace mems_stiction
