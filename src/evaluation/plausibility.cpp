#include "evaluation/plausibility.hpp"

#include <algorithm>
#include <utility>

#include "configuration/idle_settings.hpp"
#include "configuration/usual_values.hpp"
#include "evaluation/breakdown.hpp"
#include "evaluation/half_space_call.hpp"
#include "loads/force_range.hpp"
#include "numeric/rounding.hpp"
#include "verdict/missing_scan.hpp"

namespace mems_stiction {
namespace {

constexpr double kSoftestShare =
    2e-4;  // hardness over modulus: a quarter of that of indium, the softest metal for devices
constexpr double kSlenderness = 5.0;  // length over thickness of a beam
// gap over length of an arm: there the force of small slopes is 4 % below that of the elastica
constexpr double kLargestSlant = 0.2;

/// Below, Kelvin's radius is less than 0.23 nm.
constexpr double kLeastHumidity = 0.1;
/// Beyond, a face carries drops and no film [rad].
constexpr double kHardlyWets = 1.0;
/// Between atoms of two faces that nearly touch [m].
constexpr double kShortestRange = 5e-11;
constexpr double kLongestRange = 2e-9;

/// What settings say of each other.
void addContradictions(const Configuration& configuration, std::vector<std::string>& lines) {
  const auto checkBody = [&lines](const std::string& body, const Material& material) {
    const bool is_named = !isUsual(body + "/hardness", material.hardness);
    if (is_named || material.hardness >= kSoftestShare * material.youngs_modulus) return;
    lines.push_back(body + "/hardness " + fourDigits(material.hardness) + " Pa beside " + body +
                    "/youngs_modulus " + fourDigits(material.youngs_modulus) +
                    " Pa is softer than any solid (" + fourDigits(kSoftestShare) +
                    " of its modulus): are both units right?");
  };
  checkBody("lower", configuration.model.lower);
  checkBody("upper", configuration.model.upper);
  const auto checkPlate = [&](const std::string& body, const Material& material) {
    const LoadOptions& load = configuration.model.load;
    if (load.fieldVoltage() == 0.0 || !(material.thickness > 0.0) ||
        material.backing != Backing::kFree)
      return;
    lines.push_back(fieldSources(load) + " beside " + body + "/thickness " +
                    fourDigits(material.thickness) +
                    " m: their field presses the surfaces of the frame together and their plate "
                    "bends onto the contacts; how it "
                    "bends the whole part between its anchors is left out");
  };
  const double humidity = configuration.model.capillary.relative_humidity;
  if (humidity > 0.0 && humidity < kLeastHumidity) {
    lines.push_back("interface/relative_humidity " + fourDigits(humidity) + ": below " +
                    fourDigits(kLeastHumidity) +
                    " the meniscus is narrower than a molecule of water, and the force is far too "
                    "large: 0 is dry");
  }
  const CapillaryOptions& water = configuration.model.capillary;
  if (humidity > 0.0 && water.water_film > 0.0 && water.contact_angle > kHardlyWets) {
    lines.push_back("interface/water_film " + fourDigits(water.water_film) +
                    " m beside interface/contact_angle " + fourDigits(water.contact_angle) +
                    " rad: faces that water hardly wets have no film");
  }
  checkPlate("lower", configuration.model.lower);
  checkPlate("upper", configuration.model.upper);
  const InterfaceOptions& interface = configuration.model.interface;
  const double range = forceRange(interface, configuration.model.lower, configuration.model.upper);
  const bool are_usual = isUsual("interface/work_of_adhesion", interface.work_of_adhesion) &&
                         isUsual("interface/hamaker_constant", interface.hamaker_constant);
  if (are_usual && interface.work_of_adhesion > 0.0 && interface.hamaker_constant > 0.0 &&
      (range < kShortestRange || range > kLongestRange)) {
    lines.push_back("interface/work_of_adhesion " + fourDigits(interface.work_of_adhesion) +
                    " J/m^2 beside interface/hamaker_constant " +
                    fourDigits(interface.hamaker_constant) +
                    " J is an attraction of the range z0 = " + fourDigits(range) +
                    " m; that of atoms is " + fourDigits(kShortestRange) + " to " +
                    fourDigits(kLongestRange) + " m: are both units right?");
  }
  const DeviceOptions& device = configuration.device;
  const double of_flat = configuration.model.gainedWork();
  if (isUsual("device/apparent_work_of_adhesion", device.apparent_work_of_adhesion) &&
      exceeds(device.apparent_work_of_adhesion, of_flat)) {
    lines.push_back("device/apparent_work_of_adhesion " +
                    fourDigits(device.apparent_work_of_adhesion) + " J/m^2 exceeds the " +
                    fourDigits(of_flat) + " J/m^2 of flat surfaces: is its unit right?");
  }
  if (device.hasBeam() && exceeds(kSlenderness * device.beam_thickness, device.beam_length)) {
    lines.push_back("device/beam_length " + fourDigits(device.beam_length) +
                    " m beside device/beam_thickness " + fourDigits(device.beam_thickness) +
                    " m is no beam (at least " + fourDigits(kSlenderness) +
                    " times as long as thick): were they swapped?");
    return;
  }
  const double arm =
      device.beam_type == BeamType::kDoublyClamped ? 0.5 * device.beam_length : device.beam_length;
  if (device.hasBeam() && exceeds(device.beam_gap, kLargestSlant * arm)) {
    lines.push_back("device/beam_gap " + fourDigits(device.beam_gap) +
                    " m beside device/beam_length " + fourDigits(device.beam_length) +
                    " m bends the beam beyond small slopes (a gap of at most " +
                    fourDigits(kLargestSlant) +
                    " of what lies between clamp and contact): its force and peel number are out "
                    "of range");
  }
}

}  // namespace

std::vector<std::string> settingsWarnings(const Configuration& configuration) {
  std::vector<std::string> lines = configuration.remarks;
  const SettingRemarks remarks = settingRemarks(configuration);
  for (const std::vector<std::string>& said : {remarks.implausible, remarks.unusual}) {
    lines.insert(lines.end(), said.begin(), said.end());
  }
  addContradictions(configuration, lines);
  for (std::string& line : idleSettings(configuration)) lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> frameWarnings(const Prediction& prediction, const Options& options,
                                       const DeviceOptions& device) {
  std::vector<std::string> lines;
  const double pressure = prediction.mechanical_load / prediction.nominal_area;
  const double hardness = std::min(options.lower.hardness, options.upper.hardness);
  if (pressure > hardness) {
    lines.push_back(
        "the mechanical load of " + fourDigits(prediction.mechanical_load) + " N is " +
        fourDigits(pressure) + " Pa on this frame and more than the hardness of " +
        fourDigits(hardness) +
        " Pa: it is the load on the scanned area; load/device_force is that on the device");
  }
  for (std::string& line : breakdownWarnings(options, device, prediction.mean_gap))
    lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> warningsOf(const PreparedScan& prepared) {
  std::vector<std::string> lines = prepared.warnings;
  lines.insert(lines.end(), prepared.counter_warnings.begin(), prepared.counter_warnings.end());
  return lines;
}

std::vector<std::string> predictionWarnings(const PreparedScan& prepared,
                                            const Configuration& configuration,
                                            const Prediction& prediction, const Options& options) {
  std::vector<std::string> lines = warningsOf(prepared);
  const std::string missing = whatIsMissing(prediction.short_waves, kTheScan);
  if (!missing.empty()) lines.push_back(missing);
  if (configuration.half_space.enabled == HalfSpaceUse::kAlways) {
    const std::string coarse = coarsePixelsWarning(prepared, options, configuration.half_space);
    if (!coarse.empty()) lines.push_back(coarse);
  }
  for (const std::vector<std::string>& more :
       {settingsWarnings(configuration),
        frameWarnings(prediction, options, configuration.device)}) {
    lines.insert(lines.end(), more.begin(), more.end());
  }
  return lines;
}

}  // namespace mems_stiction
