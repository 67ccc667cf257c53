#include "mems_stiction/verdict/device_options.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "errors/short_number.hpp"
#include "mechanics/surface_forces.hpp"
#include "numeric/rounding.hpp"
#include "verdict/beam_electrode.hpp"

namespace mems_stiction {
namespace {

/// The keys of those that are 0, with "and" between.
std::string zerosOf(std::initializer_list<std::pair<const char*, double>> settings) {
  std::string text;
  for (const auto& [key, value] : settings) {
    if (value <= 0.0) text += (text.empty() ? "" : " and ") + std::string(key);
  }
  return text;
}

}  // namespace

Beam DeviceOptions::beam() const {
  return {beam_type,    beam_length,          beam_thickness, beam_gap,
          beam_modulus, beam_residual_stress, beam_width};
}

DeviceOptions DeviceOptions::withoutSpring() const {
  DeviceOptions alone = *this;
  alone.spring_stiffness = alone.travel = alone.electrode_area = 0.0;
  return alone;
}

double DeviceOptions::beamContactLength() const {
  const double of_strip = contact_area / beam_width;
  return std::min(std::max(of_strip, std::sqrt(contact_area / contacts)), beam_length);
}

void DeviceOptions::describe(OptionVisitor& visitor) {
  visitor.number("device/spring_stiffness", spring_stiffness, "N/m", Range::nonNegative(),
                 "stiffness of the suspension along the contact's normal; 0 = not stated");
  visitor.number("device/travel", travel, "m", Range::nonNegative(),
                 "travel of the part from rest to contact; 0 = not stated");
  visitor.number("device/contact_area", contact_area, "m^2", Range::nonNegative(),
                 "nominal area of all dimples together; 0 = not stated");
  visitor.integer("device/contacts", contacts, Range::within(1, 1000000),
                  "separate dimples or pads that share the contact area");
  visitor.number("device/electrode_area", electrode_area, "m^2", Range::nonNegative(),
                 "area that the voltage acts on, for the pull-in voltage; 0 = not stated");
  visitor.number("device/electrode_gap", electrode_gap, "m", Range::nonNegative(),
                 "distance of the electrodes at rest; 0 = the travel, of a beam its gap");
  visitor.enumeration("device/beam_type", beam_type,
                      {{"none", BeamType::kNone},
                       {"cantilever", BeamType::kCantilever},
                       {"doubly_clamped", BeamType::kDoublyClamped}},
                      "beam whose peel number is asked for");
  visitor.number("device/beam_length", beam_length, "m", Range::nonNegative(),
                 "length of the beam");
  visitor.number("device/beam_width", beam_width, "m", Range::nonNegative(),
                 "width of the beam, for its force and pull-in voltage; 0 = not stated");
  visitor.number("device/beam_thickness", beam_thickness, "m", Range::nonNegative(),
                 "thickness of the beam");
  visitor.number("device/beam_gap", beam_gap, "m", Range::nonNegative(),
                 "height of the beam above the substrate");
  visitor.number(
      "device/beam_modulus", beam_modulus, "Pa", Range::nonNegative(),
      "Young's modulus of the beam; of one wider than five times its thickness E/(1 - nu^2)");
  visitor.number("device/beam_residual_stress", beam_residual_stress, "Pa", Range::any(),
                 "residual stress of a doubly clamped beam, tensile positive");
  visitor.number("device/electrode_start", electrode_start, "m", Range::nonNegative(),
                 "where the electrode below a beam begins, from the clamp");
  visitor.number("device/electrode_length", electrode_length, "m", Range::nonNegative(),
                 "length of the electrode along the beam, for its pull-in voltage; 0 = not stated");
  visitor.number("device/apparent_work_of_adhesion", apparent_work_of_adhesion, "J/m^2",
                 Range::nonNegative(),
                 "of the rough interface, measured on beams; 0 = from the predicted contacts");
}

std::vector<std::string> DeviceOptions::validate() const {
  std::vector<std::string> violations = rangeViolations(*this);
  if (electrode_gap > 0.0 && exceeds(travel, electrode_gap)) {
    violations.push_back("device/travel: " + numberText(travel) +
                         " m is not allowed, must not exceed " + "device/electrode_gap " +
                         numberText(electrode_gap) + " m");
  }
  if (!hasBeam()) return violations;
  if (beam_width > 0.0 && beam_length > 0.0 && exceeds(contact_area, beam_width * beam_length)) {
    violations.push_back(
        "device/contact_area: " + numberText(contact_area) +
        " m^2 is not allowed, must not exceed device/beam_width times device/beam_length, " +
        numberText(beam_width * beam_length) + " m^2");
  }
  if (beam_length > 0.0 && exceeds(electrode_start + electrode_length, beam_length)) {
    violations.push_back("device/electrode_length: " + numberText(electrode_length) +
                         " m from device/electrode_start " + numberText(electrode_start) +
                         " m is not allowed, must end within device/beam_length " +
                         numberText(beam_length) + " m");
  }
  if (electrode_gap > 0.0 && electrode_length > 0.0 && exceeds(beam_gap, electrode_gap)) {
    violations.push_back("device/electrode_gap: " + numberText(electrode_gap) +
                         " m is not allowed, must be at least device/beam_gap " +
                         numberText(beam_gap) + " m");
  }
  if (electrode_area > 0.0 && !hasSpring()) {
    const double length = beam_width > 0.0 ? electrode_area / beam_width : 0.0;
    violations.push_back(
        "device/electrode_area: " + numberText(electrode_area) +
        " m^2 is not allowed for a beam without a spring, must be 0: its electrode is stated by "
        "device/electrode_start and device/electrode_length" +
        (length > 0.0
             ? " (of the whole device/beam_width it would be " + shortNumber(length) + " m long)"
             : ""));
  }
  const std::pair<const char*, double> sizes[] = {{"device/beam_length", beam_length},
                                                  {"device/beam_thickness", beam_thickness},
                                                  {"device/beam_gap", beam_gap},
                                                  {"device/beam_modulus", beam_modulus}};
  for (const auto& size : sizes) {
    if (size.second == 0.0) {
      violations.push_back(
          std::string(size.first) +
          ": 0 is not allowed with a device/beam_type other than none; must be > 0");
    }
  }
  return violations;
}

std::string whatPullInLacks(const DeviceOptions& device) {
  if (device.hasBeam() && !device.hasSpring()) {
    return zerosOf({{"device/beam_width", device.beam_width},
                    {"device/electrode_length", device.electrode_length}});
  }
  return zerosOf({{"device/spring_stiffness", device.spring_stiffness},
                  {"device/travel", device.travel},
                  {"device/electrode_area", device.electrode_area}});
}

std::string whatSpringLacks(const DeviceOptions& device) {
  if (device.spring_stiffness <= 0.0 && device.travel <= 0.0 && device.contact_area <= 0.0)
    return "";
  return zerosOf({{"device/spring_stiffness", device.spring_stiffness},
                  {"device/travel", device.travel},
                  {"device/contact_area", device.contact_area}});
}

double closingVoltage(const DeviceOptions& device, const InterfaceOptions& interface) {
  if (const auto electrode = electrodeOf(device, interface))
    return beamClosingVoltage(device.beam(), *electrode);
  if (!device.hasSpring() || device.electrode_area <= 0.0)
    return std::numeric_limits<double>::quiet_NaN();
  const double rest_gap = device.electrode_gap > 0.0 ? device.electrode_gap : device.travel;
  const double thickness = interface.insulator_thickness;
  const double permittivity = interface.insulator_relative_permittivity;
  const double electrical_gap = rest_gap + thickness / permittivity;
  if (3.0 * device.travel >= electrical_gap) {
    return surface_forces::pullInVoltage(device.spring_stiffness, rest_gap, device.electrode_area,
                                         thickness, permittivity);
  }
  const double pressure_of_one_volt =
      surface_forces::electrostaticPressure(rest_gap - device.travel, 1.0, thickness, permittivity);
  return std::sqrt(device.restoringForce() / (device.electrode_area * pressure_of_one_volt));
}

}  // namespace mems_stiction
