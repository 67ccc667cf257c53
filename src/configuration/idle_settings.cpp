#include "configuration/idle_settings.hpp"

#include <map>

#include "numeric/words.hpp"
#include "prediction/contact_solvers.hpp"
#include "settings/option_values.hpp"

namespace mems_stiction {
namespace {

/// A line per setting, or group of them, that has no effect while another one is as it is.
struct Idle {
  const char*
      key;  ///< a whole one, or with its last slash or underscore what all of a group begin with
  bool (*is_idle)(const Configuration& configuration);
  const char* why;
};

template <CounterSurfaceType Type>
bool isNotOfType(const Configuration& configuration) {
  return configuration.counter_surface.type != Type;
}

bool isWithoutDeviceForce(const Configuration& all) {
  return !all.device_force.enabled || all.device.contact_area == 0.0;
}

constexpr const char* kNoDeviceForce = "device_force/enabled is false or device/contact_area is 0";
constexpr const char* kNotGaussian = "counter_surface/type is not gaussian";
constexpr const char* kNotSelfAffine = "counter_surface/type is not self_affine";
constexpr const char* kNoFile = "counter_surface/type is not file";

constexpr Idle kIdle[] = {
    {"preprocessing/lines/degree",
     [](const Configuration& all) {
       return all.preprocessing.lines.method != LineAlignment::kPolynomial;
     },
     "preprocessing/lines/method is not polynomial"},
    {"preprocessing/spikes/",
     [](const Configuration& all) { return !all.preprocessing.spikes.enabled; },
     "preprocessing/spikes/enabled is false"},
    {"preprocessing/fill/",
     [](const Configuration& all) { return !all.preprocessing.fill.enabled; },
     "preprocessing/fill/enabled is false"},
    {"preprocessing/tip/half_angle",
     [](const Configuration& all) { return all.preprocessing.tip.radius == 0.0; },
     "preprocessing/tip/radius is 0"},
    {"preprocessing/level_robust",
     [](const Configuration& all) { return all.preprocessing.level.shape == LevelShape::kNone; },
     "preprocessing/level is none"},
    {"preprocessing/refine/interpolation",
     [](const Configuration& all) { return all.preprocessing.refine.factor == 1; },
     "preprocessing/refine/factor is 1"},
    {"counter_surface/file", isNotOfType<CounterSurfaceType::kFile>, kNoFile},
    {"counter_surface/channel", isNotOfType<CounterSurfaceType::kFile>, kNoFile},
    {"counter_surface/seed",
     [](const Configuration& all) { return !all.counter_surface.isGenerated(); },
     "counter_surface/type is neither gaussian nor self_affine"},
    {"counter_surface/correlation",
     [](const Configuration& all) { return !all.counter_surface.isGenerated(); },
     "counter_surface/type is neither gaussian nor self_affine"},
    {"counter_surface/correlation_length",
     [](const Configuration& all) { return !all.counter_surface.fitsScan(); },
     "counter_surface/correlation is 0 or its type is neither gaussian nor self_affine"},
    {"counter_surface/gaussian/", isNotOfType<CounterSurfaceType::kGaussian>, kNotGaussian},
    {"counter_surface/self_affine/", isNotOfType<CounterSurfaceType::kSelfAffine>, kNotSelfAffine},
    {"output/hurst_", [](const Configuration& all) { return !all.spatial_roughness.enabled; },
     "output/spatial_roughness is false"},
    {"device/guidance",
     [](const Configuration& all) { return !skillsOf(all.model.formulation).tilts_plates; },
     "the separation curve alone lets a part tilt"},
    {"device/contacts", [](const Configuration& all) { return all.device.contact_area == 0.0; },
     "device/contact_area is 0"},
    {"device_force/realisations", isWithoutDeviceForce, kNoDeviceForce},
    {"device_force/pitch", isWithoutDeviceForce, kNoDeviceForce},
    {"device_force/max_cells", isWithoutDeviceForce, kNoDeviceForce},
    {"device_force/seed", isWithoutDeviceForce, kNoDeviceForce},
    {"device/travel",
     [](const Configuration& all) {
       return all.device.hasBeam() && all.device.spring_stiffness == 0.0;
     },
     "device/spring_stiffness is 0 and the gap of a beam is device/beam_gap"},
    {"device/spring_stiffness",
     [](const Configuration& all) { return all.device.hasBeam() && all.device.travel == 0.0; },
     "device/travel is 0"},
    {"device/electrode_start",
     [](const Configuration& all) {
       return all.device.hasBeam() && all.device.electrode_length == 0.0;
     },
     "device/electrode_length is 0"},
    {"device/electrode_start", [](const Configuration& all) { return !all.device.hasBeam(); },
     "device/beam_type is none"},
    {"device/electrode_length", [](const Configuration& all) { return !all.device.hasBeam(); },
     "device/beam_type is none"},
    {"device/electrode_length",
     [](const Configuration& all) { return all.device.hasBeam() && all.device.beam_width == 0.0; },
     "device/beam_width is 0"},
    {"device/beam_", [](const Configuration& all) { return !all.device.hasBeam(); },
     "device/beam_type is none"},
    {"device/apparent_work_of_adhesion",
     [](const Configuration& all) { return !all.device.hasBeam(); }, "device/beam_type is none"},
    {"device/beam_residual_stress",
     [](const Configuration& all) { return all.device.beam_type == BeamType::kCantilever; },
     "device/beam_type cantilever has none"},
};

bool isMeant(const std::string& pattern, const std::string& key) {
  const bool is_group = pattern.back() == '/' || pattern.back() == '_';
  return is_group ? startsWith(key, pattern) : key == pattern;
}

/// Every setting as text.
std::map<std::string, std::string> textsOf(const Configuration& configuration) {
  std::map<std::string, std::string> texts;
  visitValues(configuration, [&texts](const std::string& key, const auto& value) {
    texts[key] = valueText(value);
  });
  return texts;
}

}  // namespace

std::vector<std::string> idleSettings(const Configuration& configuration) {
  static const std::map<std::string, std::string> defaults = textsOf(Configuration());
  const std::map<std::string, std::string> texts = textsOf(configuration);
  std::vector<std::string> lines;
  const auto addAll = [&](const std::string& pattern, const std::string& why) {
    for (const auto& [key, text] : texts) {
      if (!isMeant(pattern, key) || text == defaults.at(key)) continue;
      lines.push_back(key + (" " + text) + " has no effect: " + why);
    }
  };
  for (const IgnoredSetting& ignored :
       ignoredSettings(configuration.model.formulation, configuration.model)) {
    addAll(ignored.key, ignored.why);
  }
  for (const Idle& idle : kIdle) {
    if (idle.is_idle(configuration)) addAll(idle.key, idle.why);
  }
  return lines;
}

}  // namespace mems_stiction
