#include "configuration/usual_values.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "errors/plain_format.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "numeric/constants.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr double kBeyond = 10.0;  // times what is usual: no material, device or instrument has it

struct Unit {
  const char* name;
  double factor;       ///< in SI
  double shift = 1.0;  ///< of them are meant by a stated 1: 40e-6 is 40 um^2 with the prefix of um
};

/// What is usual: wide enough for every material, device and instrument that we know of.
struct Usual {
  double lower, upper;      ///< of the magnitude, SI
  std::vector<Unit> units;  ///< in which it is often stated, the likeliest first
  double least = 0.0;       ///< smaller ones are implausible; 0 = lower / kBeyond
  double most = 0.0;        ///< larger ones are implausible; 0 = upper * kBeyond

  bool contains(double value) const { return lower <= std::abs(value) && std::abs(value) <= upper; }
  double lowest() const { return least > 0.0 ? least : lower / kBeyond; }
  double highest() const { return most > 0.0 ? most : upper * kBeyond; }
  bool isImplausible(double value) const {
    constexpr double kRoundOff = 1e-9;
    return std::abs(value) < (1.0 - kRoundOff) * lowest() ||
           std::abs(value) > (1.0 + kRoundOff) * highest();
  }
};

const std::map<std::string, Usual>& usualValues() {
  static const Usual modulus{1e6, 2e12, {{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}}, 1e6, 2e12};
  static const Usual hardness{1e5,
                              2e11,
                              {{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}},
                              0.0,
                              1e300};  // a body that shall not flow
  static const Usual atomic{3e-11, 5e-9, {{"nm", 1e-9}, {"Angstrom", 1e-10}, {"pm", 1e-12}}};
  static const Usual layer{3e-10, 1e-4, {{"nm", 1e-9}, {"um", 1e-6}, {"Angstrom", 1e-10}}};
  static const Usual layer_or_part{3e-10, 1e-2, {{"um", 1e-6}, {"nm", 1e-9}, {"mm", 1e-3}}};
  static const Usual film{1e-10, 1e-6, {{"nm", 1e-9}, {"Angstrom", 1e-10}, {"um", 1e-6}}};
  static const Usual hamaker{1e-23, 1e-17, {{"zJ", 1e-21}, {"aJ", 1e-18}}};
  static const Usual retardation{1e-9, 1e-6, {{"nm", 1e-9}, {"um", 1e-6}}};
  static const Usual tip{1e-10, 1e-3, {{"nm", 1e-9}, {"um", 1e-6}}, 0.0, 1e-3};
  static const Usual travel{1e-9, 1e-3, {{"um", 1e-6}, {"nm", 1e-9}, {"mm", 1e-3}}};
  static const std::vector<Unit> areas{{"um^2", 1e-12}, {"um^2", 1e-12, 1e6}, {"mm^2", 1e-6}};
  static const Usual contact_area{1e-14, 1e-6, areas, 1e-20, 1e-4};  // 0.1 nm square to 1 cm^2
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
      {"lower/film_thickness", film},
      {"upper/film_thickness", film},
      {"lower/hamaker_constant", hamaker},
      {"upper/hamaker_constant", hamaker},
      {"lower/hardness", hardness},
      {"upper/hardness", hardness},
      // no two solids hold each other by more than 20 J/m^2: twice the surface energy of diamond
      {"interface/work_of_adhesion", {1e-6, 10.0, {{"mJ/m^2", 1e-3}, {"uJ/m^2", 1e-6}}, 0.0, 20.0}},
      {"device/apparent_work_of_adhesion", {1e-15, 10.0, {{"mJ/m^2", 1e-3}, {"uJ/m^2", 1e-6}}}},
      {"interface/hamaker_constant", hamaker},
      {"interface/retardation_length", retardation},
      {"interface/water_film", {1e-10, 2e-8, {{"nm", 1e-9}, {"Angstrom", 1e-10}, {"um", 1e-6}}}},
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
      {"device/beam_width", beam},
      {"device/electrode_start", beam},
      {"device/electrode_length", beam},
      {"device/beam_thickness", beam},
      {"device/beam_gap", travel},
      {"device/beam_residual_stress", {1e3, 2e10, {{"MPa", 1e6}, {"GPa", 1e9}}}},
      {"paper/step", {1e-14, 1e-7, {{"nm", 1e-9}, {"pm", 1e-12}}}},
      {"counter_surface/correlation_length", wavelength},
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

/// Sections of numbers that are chosen for the program, and no constants of nature: they may be
/// odd, but are not implausible.
constexpr const char* kChosen[] = {"paper/", "device_force/", "output/", "preprocessing/",
                                   "half_space/"};

bool isChosen(const std::string& key) {
  return key != "preprocessing/tip/radius" &&
         std::any_of(std::begin(kChosen), std::end(kChosen),
                     [&](const char* section) { return startsWith(key, section); });
}

constexpr double kColdest = 100.0;  // [K]; below it a temperature is one in degrees Celsius
constexpr double kIcePoint = 273.15;

class UsualCheck : public OptionVisitor {
 public:
  void number(const std::string& key, double& value, const std::string& unit, const Range& range,
              const std::string&) override {
    if (key == "interface/temperature") {
      if (value < kColdest) {
        remarks_.unusual.push_back(key + " " + fourDigits(value) +
                                   " K is unusual: probably degrees Celsius; write " +
                                   fourDigits(value + kIcePoint));
      }
      return;
    }
    const auto found = usualValues().find(key);
    if (found == usualValues().end() || value == 0.0 || !range.contains(value)) return;
    const Usual& usual = found->second;
    const bool is_implausible = !isChosen(key) && usual.isImplausible(value);
    if (!is_implausible && usual.contains(value)) return;
    const std::string line = key + " " + fourDigits(value) + " " + unit;
    if (is_implausible) {
      remarks_.implausible.push_back(line + " is implausible (" + fourDigits(usual.lowest()) +
                                     " to " + fourDigits(usual.highest()) + " " + unit +
                                     " are taken): " + meant(usual, value));
    } else {
      remarks_.unusual.push_back(line + " is outside the usual " + fourDigits(usual.lower) +
                                 " to " + fourDigits(usual.upper) + " " + unit + ": " +
                                 meant(usual, value));
    }
  }
  void integer(const std::string&, int&, const Range&, const std::string&) override {}
  void flag(const std::string&, bool&, const std::string&) override {}
  void text(const std::string&, std::string&, const std::string&) override {}
  void choice(const std::string&, std::string&, const std::vector<std::string>&,
              const std::string&) override {}

  const SettingRemarks& remarks() const { return remarks_; }

 private:
  /// What was probably meant, by the first unit in which the number is usual.
  static std::string meant(const Usual& usual, double value) {
    for (const Unit& unit : usual.units) {
      const double number = value * unit.shift;
      const double in_si = number * unit.factor;
      if (usual.contains(in_si)) {
        return "probably " + fourDigits(number) + " " + unit.name + "; write " + fourDigits(in_si);
      }
    }
    return "is its unit right?";
  }

  SettingRemarks remarks_;
};

}  // namespace

std::string fourDigits(double value) { return plainFormat("%.4g", value); }

SettingRemarks settingRemarks(const Configuration& configuration) {
  UsualCheck check;
  describeConst(configuration, check);
  return check.remarks();
}

bool isUsual(const std::string& key, double value) { return usualValues().at(key).contains(value); }

}  // namespace mems_stiction
