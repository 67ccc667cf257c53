/// sensitivity_study: how much does each numerical setting move a prediction? Writes JSON for scripts/sensitivity.

#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "mems_stiction/equilibrium/approach_search.hpp"
#include "mems_stiction/prediction/prediction_fields.hpp"
#include "mems_stiction/scan/configuration_yaml.hpp"
#include "study_cases.hpp"
#include "tools/command_line.hpp"

namespace {

using namespace mems_stiction;
using Json = nlohmann::ordered_json;

struct Arguments {
  int scans = 12;
  int pixels = 1024;
  double pressure = 10e6;
  std::string configuration;
  std::vector<std::string> files;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description("Predicts surfaces with one setting changed at a time; prints what came out as JSON.");
  app.add_option("SCAN", arguments.files, "scan files in place of the generated surfaces; each is cut into quarters")
      ->type_name("");
  app.add_option("-c,--config", arguments.configuration, "what everything else is set to")->type_name("FILE.yaml");
  app.add_option("--scans", arguments.scans, "of each generated surface")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  app.add_option("--pixels", arguments.pixels, "of a side of each generated scan")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  app.add_option("--pressure", arguments.pressure, "mechanical load over the scanned area [Pa]")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

/// Lines for whoever watches: how many predictions are done.
class Progress {
 public:
  explicit Progress(std::size_t total) : total_(total) {}
  void next() { std::cerr << "done " << ++done_ << " of " << total_ << std::endl; }

 private:
  std::size_t total_, done_ = 0;
};

const char* kindName(study::Kind kind) {
  if (kind == study::Kind::kNumerical) return "numerical";
  return kind == study::Kind::kModel ? "model" : "physical";
}

/// The figures of a prediction by their names, but the wall time, so that the same call prints the same.
class Figures {
 public:
  void operator()(const char* name, double value, const char* /*unit*/) { figures_[name] = value; }
  void operator()(const char* name, int value, const char* /*unit*/) { figures_[name] = value; }
  void operator()(const char* name, bool value, const char* /*unit*/) { figures_[name] = value; }
  template <typename Enum>
  void operator()(const char* name, Enum value, const char* /*unit*/) {
    figures_[name] = word(value);
  }

  static Json of(const study::Outcome& outcome) {
    Figures visitor;
    visitPredictionFields(outcome.prediction, visitor);
    visitor.figures_.erase("processing_time");
    visitor.figures_["pitch"] = outcome.pitch;
    return visitor.figures_;
  }

 private:
  Json figures_;
};

Json studied(const study::Surface& surface, const std::vector<study::Case>& cases, const Configuration& configuration,
             double pressure, Progress& progress) {
  std::vector<Json> outcomes(cases.size(), Json::array());
  for (int index = 0; index < surface.count; ++index) {
    const study::Place place = surface.place(index);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      outcomes[i].push_back(Figures::of(study::predictCase(cases[i], configuration, pressure, place)));
      progress.next();
    }
  }
  Json changes = Json::array();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    changes.push_back({{"key", cases[i].key},
                       {"value", cases[i].value},
                       {"kind", kindName(cases[i].kind)},
                       {"is_default", cases[i].is_default},
                       {"pitch_factor", cases[i].pitch_factor},
                       {"outcomes", outcomes[i]}});
  }
  return {{"name", surface.name}, {"description", surface.description}, {"cases", changes}};
}

int run(const Arguments& arguments) {
  Configuration configuration;
  configuration.preprocessing.level.shape = arguments.files.empty() ? LevelShape::kNone : LevelShape::kPlane;
  if (!arguments.configuration.empty()) configuration = loadConfiguration(arguments.configuration);
  configuration.model.approach.step = 0.0;  // the automatic one, which the others are compared with

  std::vector<study::Surface> surfaces;
  for (const std::string& path : arguments.files) surfaces.push_back(study::surfaceOfFile(path, configuration));
  const bool is_generated = surfaces.empty();
  if (is_generated) surfaces = study::generatedSurfaces(arguments.scans, arguments.pixels);
  const std::vector<study::Case> cases = study::allCases(configuration, is_generated);
  std::vector<study::Case> limits;
  for (const study::Case& change : cases) {
    if (change.key == "approach/max_contact_fraction") limits.push_back(change);
  }
  const std::vector<study::Surface> near_bonding = study::surfacesNearBonding(arguments.scans, arguments.pixels / 2);

  std::size_t total = 0;
  for (const study::Surface& surface : surfaces) total += cases.size() * static_cast<std::size_t>(surface.count);
  for (const study::Surface& surface : near_bonding) total += limits.size() * static_cast<std::size_t>(surface.count);
  Progress progress(total);

  Json result = {{"pressure", arguments.pressure},
                 {"pixels", arguments.pixels},
                 {"steps_per_rms_height", 1.0 / approachStep(ApproachOptions(), 1.0, 1.0)},
                 {"min_contact_pixels", configuration.resolution.min_contact_pixels},
                 {"samples", configuration.uncertainty.samples},
                 {"surfaces", Json::array()},
                 {"near_bonding", Json::array()},
                 {"intervals", Json::array()}};
  for (const study::Surface& surface : surfaces) {
    result["surfaces"].push_back(studied(surface, cases, configuration, arguments.pressure, progress));
    Json rows = Json::array();
    for (const study::IntervalScatter& row :
         study::intervalScatter(configuration, arguments.pressure, surface.place(0))) {
      rows.push_back({{"samples", row.samples},
                      {"lower", row.lower},
                      {"upper", row.upper},
                      {"lower_scatter", row.lower_scatter},
                      {"upper_scatter", row.upper_scatter}});
    }
    result["intervals"].push_back({{"name", surface.name}, {"rows", rows}});
  }
  for (const study::Surface& surface : near_bonding) {
    result["near_bonding"].push_back(studied(surface, limits, configuration, 0.0, progress));
  }
  std::cout << result.dump(1) << std::endl;
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return runProgram<Arguments>("sensitivity_study", argc, argv, describe, run); }
