/// A setting is ignored when no bit of a prediction, or of the intervals of its figures, goes with
/// it: every setting is changed, for every formulation.

#include "prediction/contact_solvers.hpp"

#include <algorithm>
#include <ios>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "prediction/prediction_fields.hpp"
#include "support/sample_frames.hpp"
#include "verdict/margin_uncertainty.hpp"

namespace mems_stiction {
namespace {

struct Settings {
  Options model;
  UncertaintyOptions uncertainty;

  void describe(OptionVisitor& visitor) {
    model.describe(visitor);
    uncertainty.describe(visitor);
  }
};

/// Every setting bears on something: voltage, water, load, contacts that flow in bodies of nearly
/// the same hardness.
Settings busy() {
  Settings settings;
  settings.model.lower.hardness = 2.0e9;
  settings.model.upper.hardness = 2.1e9;
  for (Material* body : {&settings.model.lower, &settings.model.upper}) {
    body->thickness = 20e-9;
    body->film_thickness = 2e-9;
    body->hamaker_constant = 261e-21;
  }
  settings.model.interface.retardation_length = 20e-9;
  settings.model.interface.insulator_thickness = 100e-9;
  settings.model.load.voltage = 5.0;
  settings.model.load.contact_potential = 1.0;
  settings.model.load.mechanical_load = 2e-6;
  settings.model.capillary.relative_humidity = 0.4;
  settings.model.capillary.water_film = 0.5e-9;
  settings.uncertainty.samples = 8;
  return settings;
}

/// What may be set, not what is; and loads that are made into mechanical_load before a solver is
/// asked.
const std::vector<std::string> kNotOfASolver = {"load/max_voltage", "load/max_mechanical_load",
                                                "load/pressure", "load/device_force",
                                                "approach/formulation"};

/// Whether a setting tells what lies behind the surface of a body: the curve asks it whether to
/// doubt itself, the half-space what the body resists.
bool isOfThickness(const std::string& key) {
  return key == "lower/thickness" || key == "upper/thickness" ||
         key.find("/backing") != std::string::npos || key.find("/substrate/") != std::string::npos;
}

/// Lists the keys, or changes the setting of one.
class Change : public OptionVisitor {
 public:
  Change() = default;
  explicit Change(std::string key) : changed_(std::move(key)) {}

  void number(const std::string& key, double& value, const std::string&, const Range&,
              const std::string&) override {
    static const std::map<std::string, double> others = {{"paper/step", 0.3e-9},
                                                         {"approach/max_contact_fraction", 1e-3},
                                                         {"interface/hardness_ratio_limit", 0.99},
                                                         {"interface/contact_angle", 0.5}};
    const auto other = others.find(key);
    if (isChanged(key)) value = other == others.end() ? 1.1 * value : other->second;
  }
  void integer(const std::string& key, int& value, const Range&, const std::string&) override {
    static const std::map<std::string, int> others = {{"approach/max_steps", 3},
                                                      {"approach/connectivity", 8},
                                                      {"uncertainty/samples", 9},
                                                      {"uncertainty/seed", 2}};
    if (isChanged(key)) value = others.at(key);
  }
  void flag(const std::string& key, bool& value, const std::string&) override {
    if (isChanged(key)) value = !value;
  }
  void text(const std::string& key, std::string&, const std::string&) override { isChanged(key); }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>& names,
              const std::string&) override {
    if (isChanged(key)) value = value == names[0] ? names[1] : names[0];
  }

  const std::vector<std::string>& keys() const { return keys_; }

 private:
  bool isChanged(const std::string& key) {
    keys_.push_back(key);
    return key == changed_;
  }

  std::string changed_;
  std::vector<std::string> keys_;
};

/// Writes what it is called with, to the bit.
struct Bits {
  std::ostringstream text;

  Bits() { text << std::hexfloat; }
  template <typename Value>
  void operator()(const Figure& figure, const Value& value) {
    text << figure.name << ' ' << shown(value) << '\n';
  }
  void add(const cv::Mat& map) {
    text << map.rows << ' ' << (map.empty() ? 0.0 : cv::norm(map, cv::NORM_L2)) << '\n';
  }
};

std::string bitsOf(const Settings& settings) {
  Prediction prediction =
      AdhesionModel(settings.model).predict(samples::gaussian(32, 32, 4e-9, 4e-9, 3e-9, 15e-9, 5));
  prediction.processing_time = 0.0;
  Bits bits;
  visitPredictionFields(prediction, bits);
  visitRoughnessFields(prediction.roughness, bits);
  for (const Asperity& asperity : prediction.asperities) {
    bits.text << asperity.load << ' ' << asperity.contact_radius << ' ' << asperity.plasticity_index
              << '\n';
  }
  bits.text << prediction.energy_curve.size() << '\n';
  for (const SeparationCurvePoint& point : prediction.curve)
    visitSeparationPointFields(point, bits);
  for (const cv::Mat& map :
       {prediction.contact_map, prediction.deformed_lower, prediction.deformed_upper})
    bits.add(map);
  const AdhesionSpread spread = adhesionSpread(prediction, settings.model, settings.uncertainty);
  for (const std::vector<double>& samples : {spread.pull_off, spread.apparent_work}) {
    for (const double sample : samples) bits.text << sample << '\n';
  }
  return bits.text.str();
}

void expectThatOnlyUsedSettingsChangeBits(Settings settings, const std::string& formulation) {
  settings.model.formulation = formulation;
  const std::vector<IgnoredSetting> ignored = ignoredSettings(formulation, settings.model);
  const std::string before = bitsOf(settings);
  Change all;
  describeConst(settings, all);
  for (const IgnoredSetting& setting : ignored) {
    EXPECT_EQ(std::count(all.keys().begin(), all.keys().end(), setting.key), 1) << setting.key;
  }
  for (const std::string& key : all.keys()) {
    if (std::count(kNotOfASolver.begin(), kNotOfASolver.end(), key) > 0) continue;
    Settings changed = settings;
    Change change(key);
    changed.describe(change);
    const bool is_ignored =
        std::any_of(ignored.begin(), ignored.end(),
                    [&](const IgnoredSetting& setting) { return setting.key == key; });
    if (!is_ignored && isOfThickness(key) && skillsOf(formulation).doubts_thin_bodies) continue;
    EXPECT_EQ(bitsOf(changed) == before, is_ignored) << key << " with " << formulation;
  }
}

TEST(IgnoredSettings, areThoseThatChangeNoBit) {
  for (const std::string& formulation : formulationNames()) {
    expectThatOnlyUsedSettingsChangeBits(busy(), formulation);
    Settings dry = busy();
    dry.model.capillary.relative_humidity = 0.0;
    const std::vector<IgnoredSetting> ignored = ignoredSettings(formulation, dry.model);
    for (const char* of_water :
         {"interface/surface_tension", "interface/contact_angle", "interface/temperature",
          "interface/molar_volume", "interface/water_film"}) {
      Settings changed = dry;
      changed.model.formulation = dry.model.formulation = formulation;
      Change change(of_water);
      changed.describe(change);
      EXPECT_TRUE(bitsOf(changed) == bitsOf(dry)) << of_water;
      EXPECT_TRUE(std::any_of(ignored.begin(), ignored.end(), [&](const IgnoredSetting& one) {
        return std::string(one.key) == of_water;
      })) << of_water;
    }
  }
}

TEST(IgnoredSettings, theUncertaintyOfNoContactPotentialIsOne) {
  const std::string key = "uncertainty/contact_potential";
  for (const std::string& formulation : formulationNames()) {
    Settings settings = busy();
    settings.model.formulation = formulation;
    settings.model.load.contact_potential = 0.0;
    Settings changed = settings;
    Change change(key);
    changed.describe(change);
    EXPECT_TRUE(bitsOf(changed) == bitsOf(settings)) << formulation;
    const std::vector<IgnoredSetting> ignored = ignoredSettings(formulation, settings.model);
    EXPECT_TRUE(std::any_of(ignored.begin(), ignored.end(), [&](const IgnoredSetting& one) {
      return one.key == key;
    })) << formulation;
  }
}

TEST(IgnoredSettings, countAgainWhereNothingTakesTheirPlace) {
  Settings settings = busy();
  settings.model.interface.hamaker_constant = 0.0;
  settings.model.lower.film_thickness = settings.model.upper.film_thickness = 0.0;
  const std::vector<IgnoredSetting> ignored = ignoredSettings(kDefaultFormulation, settings.model);
  Settings changed = settings;
  changed.model.interface.equilibrium_distance *= 1.1;
  EXPECT_TRUE(bitsOf(changed) != bitsOf(settings));
  for (const IgnoredSetting& setting : ignored)
    EXPECT_NE(std::string(setting.key), "interface/equilibrium_distance");
}

}  // namespace
}  // namespace mems_stiction
