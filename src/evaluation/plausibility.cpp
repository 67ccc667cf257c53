#include "evaluation/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "configuration/idle_settings.hpp"
#include "errors/plain_format.hpp"
#include "evaluation/breakdown.hpp"

namespace mems_stiction {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSoftestShare =
    2e-4;  // hardness over modulus: a quarter of that of indium, the softest metal for devices
constexpr double kSlenderness = 5.0;  // length over thickness of a beam

struct Unit {
  const char* name;
  double factor;       ///< in SI
  double shift = 1.0;  ///< of them are meant by a stated 1: 40e-6 is 40 um^2 with the prefix of um
};

/// What is usual: wide enough for every material, device and instrument that we know of.
struct Usual {
  double lower, upper;      ///< of the magnitude, SI
  std::vector<Unit> units;  ///< in which it is often stated, the likeliest first

  bool contains(double value) const { return lower <= std::abs(value) && std::abs(value) <= upper; }
};

const std::map<std::string, Usual>& usualValues() {
  static const Usual modulus{1e5, 2e12, {{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}}};
  static const Usual hardness{1e5, 2e11, {{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}}};
  static const Usual atomic{3e-11, 5e-9, {{"nm", 1e-9}, {"Angstrom", 1e-10}, {"pm", 1e-12}}};
  static const Usual layer{3e-10, 1e-4, {{"nm", 1e-9}, {"um", 1e-6}, {"Angstrom", 1e-10}}};
  static const Usual layer_or_part{3e-10, 1e-2, {{"um", 1e-6}, {"nm", 1e-9}, {"mm", 1e-3}}};
  static const Usual tip{1e-10, 1e-3, {{"nm", 1e-9}, {"um", 1e-6}}};
  static const Usual travel{1e-9, 1e-3, {{"um", 1e-6}, {"nm", 1e-9}, {"mm", 1e-3}}};
  static const std::vector<Unit> areas{{"um^2", 1e-12}, {"um^2", 1e-12, 1e6}, {"mm^2", 1e-6}};
  static const Usual contact_area{1e-14, 1e-6, areas};
  static const Usual electrode_area{1e-14, 1e-5, areas};
  static const Usual beam{1e-8, 1e-1, {{"um", 1e-6}, {"mm", 1e-3}, {"nm", 1e-9}}};
  static const Usual roughness{1e-12, 1e-4, {{"nm", 1e-9}, {"um", 1e-6}, {"Angstrom", 1e-10}}};
  static const Usual wavelength{1e-10, 1e-2, {{"nm", 1e-9}, {"um", 1e-6}}};
  static const Usual place{1e-12, 1e-1, {{"um", 1e-6}, {"nm", 1e-9}}};
  static const std::vector<Unit> degrees{{"degrees", kPi / 180.0}};
  static const std::map<std::string, Usual> values = {
      {"lower/youngs_modulus", modulus},
      {"upper/youngs_modulus", modulus},
      {"device/beam_modulus", modulus},
      {"lower/substrate/youngs_modulus", modulus},
      {"upper/substrate/youngs_modulus", modulus},
      {"lower/thickness", layer_or_part},
      {"upper/thickness", layer_or_part},
      {"lower/hardness", hardness},
      {"upper/hardness", hardness},
      {"interface/work_of_adhesion", {1e-6, 10.0, {{"mJ/m^2", 1e-3}, {"uJ/m^2", 1e-6}}}},
      {"device/apparent_work_of_adhesion", {1e-15, 10.0, {{"mJ/m^2", 1e-3}, {"uJ/m^2", 1e-6}}}},
      {"interface/hamaker_constant", {1e-23, 1e-17, {{"zJ", 1e-21}, {"aJ", 1e-18}}}},
      {"paper/cutoff_distance", atomic},
      {"interface/equilibrium_distance", atomic},
      {"interface/insulator_thickness", layer},
      {"interface/surface_tension", {1e-3, 2.0, {{"mN/m", 1e-3}}}},
      {"interface/molar_volume", {1e-6, 1e-3, {{"cm^3/mol", 1e-6}}}},
      {"device/spring_stiffness", {1e-5, 1e5, {{"mN/m", 1e-3}}}},
      {"device/travel", travel},
      {"device/electrode_gap", travel},
      {"device/contact_area", contact_area},
      {"device/electrode_area", electrode_area},
      {"device/beam_length", beam},
      {"device/beam_thickness", beam},
      {"device/beam_gap", travel},
      {"device/beam_residual_stress", {1e3, 2e10, {{"MPa", 1e6}, {"GPa", 1e9}}}},
      {"paper/step", {1e-14, 1e-7, {{"nm", 1e-9}, {"pm", 1e-12}}}},
      {"counter_surface/gaussian/rms_height", roughness},
      {"counter_surface/gaussian/correlation_length_x", wavelength},
      {"counter_surface/gaussian/correlation_length_y", wavelength},
      {"counter_surface/self_affine/rms_height", roughness},
      {"counter_surface/self_affine/rolloff_wavelength", wavelength},
      {"counter_surface/self_affine/cutoff_wavelength", wavelength},
      {"counter_surface/pose/offset_x", place},
      {"counter_surface/pose/offset_y", place},
      {"counter_surface/pose/rotation", {0.0, 2.0 * kPi, degrees}},
      {"counter_surface/pose/tilt_x", {0.0, 0.3, degrees}},
      {"counter_surface/pose/tilt_y", {0.0, 0.3, degrees}},
      {"device_force/pitch", wavelength},
      {"half_space/range", atomic},
      {"output/hurst_shortest_wavelength", wavelength},
      {"output/hurst_longest_wavelength", wavelength},
      {"resolution/tip_radius", tip},
      {"preprocessing/tip/radius", tip},
      {"preprocessing/low_pass/cutoff_wavelength", tip},
      {"preprocessing/region/left", place},
      {"preprocessing/region/top", place},
      {"preprocessing/region/width", place},
      {"preprocessing/region/height", place},
  };
  return values;
}

constexpr double kColdest = 100.0;  // [K]; below it a temperature is one in degrees Celsius
constexpr double kIcePoint = 273.15;

std::string rounded(double value) { return plainFormat("%.4g", value); }

class PlausibilityCheck : public OptionVisitor {
 public:
  void number(const std::string& key, double& value, const std::string& unit, const Range&,
              const std::string&) override {
    if (key == "interface/temperature") {
      if (value < kColdest) {
        lines_.push_back(key + " " + rounded(value) + " K is unusual: probably degrees Celsius; write " +
                         rounded(value + kIcePoint));
      }
      return;
    }
    const auto found = usualValues().find(key);
    if (found == usualValues().end() || value == 0.0) return;
    const Usual& usual = found->second;
    if (usual.contains(value)) return;
    std::string line = key + " " + rounded(value) + " " + unit + " is outside the usual " + rounded(usual.lower) +
                       " to " + rounded(usual.upper) + " " + unit + ": ";
    for (const Unit& meant : usual.units) {
      const double number = value * meant.shift;
      const double in_si = number * meant.factor;
      if (usual.contains(in_si)) {
        lines_.push_back(line + "probably " + rounded(number) + " " + meant.name + "; write " + rounded(in_si));
        return;
      }
    }
    lines_.push_back(line + "is its unit right?");
  }
  void integer(const std::string&, int&, const Range&, const std::string&) override {}
  void flag(const std::string&, bool&, const std::string&) override {}
  void text(const std::string&, std::string&, const std::string&) override {}
  void choice(const std::string&, std::string&, const std::vector<std::string>&, const std::string&) override {}

  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

/// What settings say of each other.
void addContradictions(const Configuration& configuration, std::vector<std::string>& lines) {
  const auto checkBody = [&lines](const std::string& body, const Material& material) {
    const bool is_named = !usualValues().at(body + "/hardness").contains(material.hardness);
    if (is_named || material.hardness >= kSoftestShare * material.youngs_modulus) return;
    lines.push_back(body + "/hardness " + rounded(material.hardness) + " Pa beside " + body + "/youngs_modulus " +
                    rounded(material.youngs_modulus) + " Pa is softer than any solid (" + rounded(kSoftestShare) +
                    " of its modulus): are both units right?");
  };
  checkBody("lower", configuration.model.lower);
  checkBody("upper", configuration.model.upper);
  const auto checkPlate = [&](const std::string& body, const Material& material) {
    const LoadOptions& load = configuration.model.load;
    if (load.voltage == 0.0 || !(material.thickness > 0.0) || material.backing != Backing::kFree) return;
    lines.push_back(
        "load/voltage " + rounded(load.voltage) + " V beside " + body + "/thickness " + rounded(material.thickness) +
        " m: the voltage presses the surfaces of the frame together and their plate bends onto the contacts; how it "
        "bends the whole part between its anchors is left out");
  };
  checkPlate("lower", configuration.model.lower);
  checkPlate("upper", configuration.model.upper);
  const DeviceOptions& device = configuration.device;
  if (device.hasBeam() && device.beam_length < kSlenderness * device.beam_thickness) {
    lines.push_back("device/beam_length " + rounded(device.beam_length) + " m beside device/beam_thickness " +
                    rounded(device.beam_thickness) + " m is no beam (at least " + rounded(kSlenderness) +
                    " times as long as thick): were they swapped?");
  }
}

}  // namespace

std::vector<std::string> settingsWarnings(const Configuration& configuration) {
  PlausibilityCheck check;
  describeConst(configuration, check);
  std::vector<std::string> lines = configuration.remarks;
  for (const std::string& line : check.lines()) lines.push_back(line);
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
    lines.push_back("the mechanical load of " + rounded(prediction.mechanical_load) + " N is " + rounded(pressure) +
                    " Pa on this frame and more than the hardness of " + rounded(hardness) +
                    " Pa: it is the load on the scanned area; load/device_force is that on the device");
  }
  for (std::string& line : breakdownWarnings(options, device, prediction.mean_gap)) lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> warningsOf(const PreparedScan& prepared) {
  std::vector<std::string> lines = prepared.warnings;
  lines.insert(lines.end(), prepared.counter_warnings.begin(), prepared.counter_warnings.end());
  return lines;
}

std::vector<std::string> predictionWarnings(const PreparedScan& prepared, const Configuration& configuration,
                                            const Prediction& prediction, const Options& options) {
  std::vector<std::string> lines = warningsOf(prepared);
  for (const std::vector<std::string>& more :
       {settingsWarnings(configuration), frameWarnings(prediction, options, configuration.device)}) {
    lines.insert(lines.end(), more.begin(), more.end());
  }
  return lines;
}

}  // namespace mems_stiction
