#include "study_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <yaml-cpp/yaml.h>

#include "mems_stiction/equilibrium/approach_search.hpp"
#include "mems_stiction/scan/configuration_yaml.hpp"
#include "mems_stiction/scan/scan_predictor.hpp"
#include "mems_stiction/verdict/margin_uncertainty.hpp"

namespace mems_stiction {
namespace study {
namespace {

/// The value of one key as text, as a configuration file has it.
class ValueOf : public OptionVisitor {
 public:
  explicit ValueOf(std::string key) : key_(std::move(key)) {}

  void number(const std::string& key, double& value, const std::string&, const Range&, const std::string&) override {
    if (key == key_) text_ = numberText(value);
  }
  void integer(const std::string& key, int& value, const Range&, const std::string&) override {
    if (key == key_) text_ = std::to_string(value);
  }
  void flag(const std::string& key, bool& value, const std::string&) override {
    if (key == key_) text_ = value ? "true" : "false";
  }
  void text(const std::string& key, std::string& value, const std::string&) override {
    if (key == key_) text_ = value;
  }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>&,
              const std::string&) override {
    if (key == key_) text_ = value;
  }

  static std::string in(Configuration configuration, const std::string& key) {
    ValueOf visitor(key);
    configuration.describe(visitor);
    return visitor.text_;
  }

 private:
  std::string key_, text_;
};

/// Cases of a key, one per value; the configured value is the default and is added if it is not among them.
void add(std::vector<Case>& cases, const Configuration& configuration, const std::string& key,
         std::vector<std::string> values, Kind kind) {
  const std::string configured = ValueOf::in(configuration, key);
  if (std::find(values.begin(), values.end(), configured) == values.end()) values.insert(values.begin(), configured);
  for (const std::string& value : values) {
    const bool is_default = value == configured;
    cases.push_back({key, value, kind, is_default, is_default ? "" : key + ": " + value, 0, 1.0});
  }
}

/// A constant, larger by its relative standard uncertainty; with a key for each body, of both.
void addPhysical(std::vector<Case>& cases, const Configuration& configuration, const std::vector<std::string>& keys,
                 double uncertainty) {
  std::string yaml;
  for (const std::string& key : keys) {
    const double value = std::stod(ValueOf::in(configuration, key));
    yaml += key + ": " + numberText(value * (1.0 + uncertainty)) + "\n";
  }
  char percent[32];
  std::snprintf(percent, sizeof percent, "+%.0f %%", 100.0 * uncertainty);
  const std::string name = keys.size() > 1 ? "hardness" : keys.front();
  cases.push_back({keys.front().find("modulus") != std::string::npos ? "youngs_modulus" : name, percent,
                   Kind::kPhysical, false, yaml, 0, 1.0});
}

Configuration configured(const Case& change, const Configuration& configuration, double pressure, const HeightMap& scan,
                         double composite_rms_height) {
  Configuration result = configuration;
  if (!change.yaml.empty()) result = configurationFromYaml(YAML::Load(change.yaml), configuration);
  if (change.steps_per_rms > 0) result.model.approach.step = composite_rms_height / change.steps_per_rms;
  result.model.output = {false, false, true, false, false};
  const double load = pressure * scan.cellArea() * static_cast<double>(scan.rows()) * scan.cols();
  result.model.load.max_mechanical_load = std::max(result.model.load.max_mechanical_load, load);
  result.model.load.mechanical_load = load;
  const RefineOptions refine = result.preprocessing.refine;
  result.preprocessing = PipelineOptions();  // places are clean
  result.preprocessing.refine = refine;
  return result;
}

/// The scan of a place with pixels of `pitch_factor` times its pitch.
HeightMap scanOf(const Place& place, double pitch_factor) {
  const int factor = static_cast<int>(std::lround(place.scan_factor * pitch_factor));
  return factor == 1 ? place.fine : decimated(place.fine, factor);
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double relativeDeviation(const std::vector<double>& values) {
  const double middle = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  return std::sqrt(sum / static_cast<double>(values.size() - 1)) / middle;
}

}  // namespace

std::vector<Case> allCases(const Configuration& configuration, bool has_finer) {
  std::vector<Case> cases;
  const Kind numerical = Kind::kNumerical;
  // The pitch is the scan's: refinement is what a configuration can do about it.
  for (const double factor : {0.5, 1.0, 2.0, 4.0}) {
    if (factor < 1.0 && !has_finer) continue;
    cases.push_back({"pitch", "", numerical, factor == 1.0, "", 0, factor});
  }
  for (const int factor : {2, 4}) {
    const std::string text = std::to_string(factor);
    cases.push_back({"pitch", "refined by " + text, numerical, false, "preprocessing/refine/factor: " + text, 0,
                     static_cast<double>(factor)});
  }
  // The automatic step is the default: what approachStep() makes of 0.
  const int automatic = static_cast<int>(std::lround(1.0 / approachStep(ApproachOptions(), 1.0, 1.0)));
  for (const int divisor : {5, 10, 25, 50, 100, 200, 500}) {
    const bool is_default = divisor == automatic;
    const std::string value = "sigma/" + std::to_string(divisor);
    cases.push_back({"approach/step", value, numerical, is_default, "", is_default ? 0 : divisor, 1.0});
  }
  add(cases, configuration, "approach/max_steps", {"100", "1000", "10000", "100000"}, numerical);
  add(cases, configuration, "approach/connectivity", {"4", "8"}, numerical);
  add(cases, configuration, "approach/max_contact_fraction", {"0.1", "0.3", "0.5", "0.7", "1"}, numerical);
  add(cases, configuration, "interface/cutoff_distance", {"1.4e-10", "1.65e-10", "2e-10", "3e-10"}, numerical);
  add(cases, configuration, "interface/equilibrium_distance", {"1.65e-10", "2e-10", "3e-10"}, numerical);
  add(cases, configuration, "preprocessing/refine/factor", {"1", "2", "4"}, numerical);
  const std::string interpolation = ValueOf::in(configuration, "preprocessing/refine/interpolation");
  for (const std::string value : {"cubic", "lanczos"}) {
    cases.push_back({"preprocessing/refine/interpolation", value, numerical, value == interpolation,
                     "preprocessing/refine: {factor: 2, interpolation: " + value + "}", 0, 1.0});
  }
  add(cases, configuration, "approach/formulation", {"consistent", "paper", "printed"}, Kind::kModel);
  add(cases, configuration, "approach/deformation", {"three_regimes", "elastic"}, Kind::kModel);

  const UncertaintyOptions& known = configuration.uncertainty;
  addPhysical(cases, configuration, {"interface/work_of_adhesion"}, known.work_of_adhesion);
  addPhysical(cases, configuration, {"lower/hardness", "upper/hardness"}, known.hardness);
  addPhysical(cases, configuration, {"lower/youngs_modulus", "upper/youngs_modulus"}, known.youngs_modulus);
  return cases;
}

Outcome predictCase(const Case& change, const Configuration& configuration, double pressure, const Place& place) {
  const HeightMap scan = scanOf(place, change.pitch_factor);
  double composite_rms_height = 0.0;
  if (change.steps_per_rms > 0) {
    ScanPredictor unchanged(configured({}, configuration, pressure, scan, 0.0));
    composite_rms_height = unchanged.predict(scan).composite_rms_height;
  }
  ScanPredictor predictor(configured(change, configuration, pressure, scan, composite_rms_height));
  return {predictor.predict(scan), scan.pitchX()};
}

std::vector<IntervalScatter> intervalScatter(const Configuration& configuration, double pressure, const Place& place) {
  constexpr int kSeeds = 40;
  const HeightMap scan = scanOf(place, 1.0);
  const Configuration used = configured({}, configuration, pressure, scan, 0.0);
  const Prediction prediction = ScanPredictor(used).predict(scan);
  std::vector<IntervalScatter> rows;
  for (const int samples : {50, 200, 1000, 5000}) {
    std::vector<double> lower, upper;
    UncertaintyOptions uncertainty = used.uncertainty;
    uncertainty.samples = samples;
    for (uncertainty.seed = 1; uncertainty.seed <= kSeeds; ++uncertainty.seed) {
      const AdhesionSpread spread = adhesionSpread(prediction, used.model, uncertainty);
      lower.push_back(quantile(spread.pull_off, 0.025));
      upper.push_back(quantile(spread.pull_off, 0.975));
    }
    rows.push_back({samples, mean(lower), mean(upper), relativeDeviation(lower), relativeDeviation(upper)});
  }
  return rows;
}

}  // namespace study
}  // namespace mems_stiction
