/// paper_study: predictions for pairs of generated surfaces, as scripts/reproduce_paper asks for them.
///
/// Input: JSON lines, one pair of surfaces each, with what is to be predicted for it:
///
///     {"size": 1024, "pitch": 1e-9,
///      "lower": {"type": "gaussian", "seed": 1, "gaussian": {...}}, "upper": {...},      keys of counter_surface/...
///      "cases": [{"name": "...", "scale": 0.1, "config": "config/gold_gold.yaml", "settings": {...}, "dump": "..."}]}
///
/// Both surfaces are drawn once and their heights multiplied by each case's `scale`, so that cases of one pair differ in
/// nothing else. `settings` are keys of config/stiction.yaml over those of the file `config`; `dump` names a folder for
/// maps, asperities and energies.
/// Output: one JSON line per case, as soon as it is done: its name and the figures of
/// StictionPrediction. The same input gives the same lines, whatever the number of jobs; only their order may differ.

#include <atomic>
#include <fstream>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <yaml-cpp/yaml.h>
#include <nlohmann/json.hpp>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/prediction/force_curve.hpp"
#include "mems_stiction/scan/configuration_yaml.hpp"
#include "mems_stiction/surface/counter_surface.hpp"
#include "tools/command_line.hpp"
#include "tools/npy_file.hpp"
#include "tools/scan_row.hpp"

namespace {

using namespace mems_stiction;

struct Arguments {
  std::string pairs;
  int jobs = 1;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description("Predictions for pairs of generated surfaces; see the head of test/paper/paper_study.cpp.");
  app.add_option("PAIRS.jsonl", arguments.pairs, "one pair of surfaces per line")->required()->check(CLI::ExistingFile);
  app.add_option("--jobs", arguments.jobs, "pairs at the same time")->check(CLI::Range(1, 1024));
}

std::vector<std::string> linesOf(const std::string& path) {
  std::ifstream stream(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The surface as a probe would see it, asperities up.
HeightMap surfaceOf(const YAML::Node& tree, const HeightMap& grid) {
  CounterSurfaceOptions options;
  YAML::Node root;
  root["counter_surface"] = tree;
  applyYaml(root, [&](OptionVisitor& visitor) { options.describe(visitor); });
  return turnedOver(generatedCounterSurface(grid, options));
}

HeightMap scaled(const HeightMap& surface, double factor) {
  return {surface.heights() * factor, surface.pitchX(), surface.pitchY()};
}

Options optionsOf(const YAML::Node& wanted, bool is_dumped) {
  Configuration configuration;
  if (wanted["config"]) configuration = loadConfiguration(wanted["config"].as<std::string>());
  if (wanted["settings"]) configuration = configurationFromYaml(wanted["settings"], configuration);
  configuration.check();
  configuration.model.output = {is_dumped, is_dumped, is_dumped, is_dumped, is_dumped};
  return configuration.model;
}

/// @return the line of one case
std::string predictCase(const YAML::Node& wanted, const HeightMap& lower, const HeightMap& upper) {
  const std::string dump = wanted["dump"] ? wanted["dump"].as<std::string>() : "";
  const double scale = wanted["scale"].as<double>();
  const HeightMap scan = scaled(lower, scale);
  const HeightMap counter = scaled(upper, scale);
  const Options options = optionsOf(wanted, !dump.empty());
  const Prediction prediction = AdhesionModel(options).predict({scan, counter});
  RowFields fields = figureFields(scan, {}, prediction, std::nullopt, options.formulation, {});
  fields.insert(fields.begin(), {"case", wanted["name"].as<std::string>()});
  if (!dump.empty()) {
    writeFullResult(dump, fields, scan, prediction, curveOf(prediction, options.interface));
    writeNpy(dump + "/counter_heights.npy", counter.heights());
  }
  return rowText(fields, RowFormat::kJsonLines, {});
}

/// @param tell called with the line of each case
template <typename Tell>
void predictPair(const std::string& line, const Tell& tell) {
  const YAML::Node wanted = YAML::Load(line);
  const int size = wanted["size"].as<int>();
  const double pitch = wanted["pitch"].as<double>();
  const HeightMap grid(cv::Mat::zeros(size, size, CV_64FC1), pitch, pitch);
  const HeightMap lower = surfaceOf(wanted["lower"], grid);
  const HeightMap upper = turnedOver(surfaceOf(wanted["upper"], grid));
  for (const YAML::Node& one : wanted["cases"]) tell(predictCase(one, lower, upper));
}

int run(const Arguments& arguments) {
  const std::vector<std::string> pairs = linesOf(arguments.pairs);
  std::atomic<std::size_t> next{0};
  std::atomic<int> status{0};
  std::mutex output;
  const auto work = [&] {
    for (std::size_t i = next++; i < pairs.size() && status == 0; i = next++) {
      try {
        predictPair(pairs[i], [&output](const std::string& text) {
          const std::lock_guard<std::mutex> lock(output);
          std::cout << text << std::flush;
        });
      } catch (const std::exception& error) {
        const std::lock_guard<std::mutex> lock(output);
        complain("paper_study", arguments.pairs + ", line " + std::to_string(i + 1) + ": " + error.what());
        status = kBadInput;
      }
    }
  };
  std::vector<std::thread> workers;
  for (int job = 1; job < arguments.jobs; ++job) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
  return status;
}

}  // namespace

int main(int argc, char** argv) { return runProgram<Arguments>("paper_study", argc, argv, describe, run); }
