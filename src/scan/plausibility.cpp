#include "mems_stiction/scan/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace mems_stiction {
namespace {

struct Unit {
  const char* name;
  double factor;  ///< in SI
};

/// What is usual: wide enough for every material, device and instrument that we know of.
struct Usual {
  double lower, upper;      ///< SI
  std::vector<Unit> units;  ///< in which it is often stated, the likeliest first
};

const std::map<std::string, Usual>& usualValues() {
  static const Usual modulus{1e5, 2e12, {{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}}};
  static const Usual hardness{1e5, 2e11, {{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}}};
  static const Usual atomic{3e-11, 5e-9, {{"nm", 1e-9}, {"Angstrom", 1e-10}, {"pm", 1e-12}}};
  static const Usual layer{1e-10, 1e-4, {{"nm", 1e-9}, {"um", 1e-6}, {"Angstrom", 1e-10}}};
  static const Usual tip{1e-10, 1e-3, {{"nm", 1e-9}, {"um", 1e-6}}};
  static const Usual travel{1e-9, 1e-3, {{"um", 1e-6}, {"nm", 1e-9}, {"mm", 1e-3}}};
  static const Usual area{1e-16, 1e-3, {{"um^2", 1e-12}, {"mm^2", 1e-6}}};
  static const Usual beam{1e-8, 1e-1, {{"um", 1e-6}, {"mm", 1e-3}, {"nm", 1e-9}}};
  static const std::map<std::string, Usual> values = {
      {"lower/youngs_modulus", modulus},
      {"upper/youngs_modulus", modulus},
      {"device/beam_modulus", modulus},
      {"lower/hardness", hardness},
      {"upper/hardness", hardness},
      {"interface/work_of_adhesion", {1e-6, 10.0, {{"mJ/m^2", 1e-3}, {"uJ/m^2", 1e-6}}}},
      {"device/apparent_work_of_adhesion", {1e-15, 10.0, {{"mJ/m^2", 1e-3}, {"uJ/m^2", 1e-6}}}},
      {"interface/hamaker_constant", {1e-23, 1e-17, {{"zJ", 1e-21}, {"aJ", 1e-18}}}},
      {"interface/cutoff_distance", atomic},
      {"interface/equilibrium_distance", atomic},
      {"interface/insulator_thickness", layer},
      {"interface/surface_tension", {1e-3, 2.0, {{"mN/m", 1e-3}}}},
      {"interface/molar_volume", {1e-6, 1e-3, {{"cm^3/mol", 1e-6}}}},
      {"device/travel", travel},
      {"device/electrode_gap", travel},
      {"device/contact_area", area},
      {"device/electrode_area", area},
      {"device/beam_length", beam},
      {"device/beam_thickness", beam},
      {"device/beam_gap", travel},
      {"approach/step", {1e-14, 1e-7, {{"nm", 1e-9}, {"pm", 1e-12}}}},
      {"resolution/tip_radius", tip},
      {"preprocessing/tip/radius", tip},
      {"preprocessing/low_pass/cutoff_wavelength", tip},
  };
  return values;
}

constexpr double kColdest = 100.0;  // [K]; below it a temperature is one in degrees Celsius
constexpr double kIcePoint = 273.15;

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

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
    if (usual.lower <= value && value <= usual.upper) return;
    std::string line = key + " " + rounded(value) + " " + unit + " is outside the usual " + rounded(usual.lower) +
                       " to " + rounded(usual.upper) + " " + unit + ": ";
    for (const Unit& meant : usual.units) {
      const double in_si = value * meant.factor;
      if (usual.lower <= in_si && in_si <= usual.upper) {
        lines_.push_back(line + "probably " + rounded(value) + " " + meant.name + "; write " + rounded(in_si));
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

}  // namespace

std::vector<std::string> settingsWarnings(const Configuration& configuration) {
  PlausibilityCheck check;
  describeConst(configuration, check);
  return check.lines();
}

std::vector<std::string> loadWarnings(const Prediction& prediction, const Options& options) {
  const double pressure = prediction.mechanical_load / prediction.nominal_area;
  const double hardness = std::min(options.lower.hardness, options.upper.hardness);
  if (!(pressure > hardness)) return {};
  return {"the mechanical load of " + rounded(prediction.mechanical_load) + " N is " + rounded(pressure) +
          " Pa on this frame and more than the hardness of " + rounded(hardness) +
          " Pa: it is the load on the scanned area; load/device_force is that on the device"};
}

}  // namespace mems_stiction
