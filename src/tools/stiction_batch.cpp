/// stiction_batch: one row per scan over many bags and scan files; goes on where it was interrupted, in shards that join
/// to what one run gives. No ROS master needed.

#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>
#include <opencv2/core/utils/logger.hpp>

#include "batch_rows.hpp"
#include "command_line.hpp"
#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/output_file.hpp"
#include "mems_stiction/height_map/scan_sanity.hpp"
#include "mems_stiction/import/import_cache.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/scan/configuration_yaml.hpp"
#include "mems_stiction/scan/scan_predictor.hpp"
#include "progress_bar.hpp"
#include "scan_bag_reader.hpp"
#include "scan_row.hpp"
#include "scans_ahead.hpp"

namespace {

using namespace mems_stiction;

struct Arguments {
  std::string configuration;
  std::optional<double> voltage;
  std::optional<double> load;
  std::string shard = "1/1";
  std::string output;
  std::string dump;
  std::string topic = "height";
  std::string input_list;
  bool merge = false;
  bool no_cache = false;
  bool clear_cache = false;
  bool ignore_mask = false;
  std::vector<std::string> inputs;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Predicts every scan of many bags and scan files and writes one row for each, in SI units, with the field names\n"
      "of mems_stiction/StictionPrediction. Called again after an interruption it goes on where it was. A scan that\n"
      "cannot be predicted is a row with its reason.");
  app.add_option("INPUT", arguments.inputs, "bags, and scan files of every kind that predict_scan reads")
      ->type_name("");
  app.add_option("--inputs-from", arguments.input_list, "a file with one more INPUT on each line")->type_name("FILE");
  app.add_option("-o,--output", arguments.output, "the rows; beside them OUT.settings.yaml, what they were made with")
      ->required()
      ->type_name("OUT.csv|OUT.jsonl");
  app.add_option("-c,--config", arguments.configuration, "every key is explained in config/stiction.yaml")
      ->type_name("FILE.yaml");
  app.add_option_function<double>(
         "-u,--voltage", [&arguments](const double& value) { arguments.voltage = value; },
         "voltage between the surfaces [V]")
      ->type_name("V");
  app.add_option_function<double>(
         "-l,--load", [&arguments](const double& value) { arguments.load = value; },
         "external force pressing the scanned area together [N]")
      ->type_name("N");
  app.add_option("-s,--shard", arguments.shard, "part I of N parts of about the same number of scans")
      ->type_name("I/N")
      ->capture_default_str();
  app.add_flag("-m,--merge", arguments.merge,
               "INPUTs are the rows of all shards: joins them to what one run writes, byte for byte");
  app.add_option("-d,--dump", arguments.dump,
                 "also write surfaces, contacts and energy curve of each scan into FOLDER/NUMBER (.npy and JSON)")
      ->type_name("FOLDER");
  app.add_option("--topic", arguments.topic, "of the scans in bags; scan_info is looked for beside it")
      ->capture_default_str();
  app.add_flag("--ignore-mask", arguments.ignore_mask,
               "pixels under the mask of a .gwy file are heights as the others, not missing");
  app.add_flag("--no-cache", arguments.no_cache,
               "convert instrument makers' files anew, and do not keep what was converted in ~/.cache/mems_stiction");
  app.add_flag("--clear-cache", arguments.clear_cache, "first remove all that is kept there");
  app.footer(
      "Exit status: 0 every scan has its row (the last line says how many failed), 2 bad input.\n\n"
      "Example: stiction_batch --config device.yaml --shard 1/2 -o part1.csv 2026-*.bag   # and 2/2 elsewhere\n"
      "         stiction_batch --merge -o all.csv part1.csv part2.csv");
}

struct Shard {
  std::size_t index = 1, count = 1;
};

/// @throw OptionsError
Shard shardOf(const std::string& text) {
  Shard shard;
  char slash = 0;
  std::istringstream stream(text);
  if (text.find('-') != std::string::npos || !(stream >> shard.index >> slash >> shard.count) || slash != '/' ||
      stream.peek() != EOF || shard.index < 1 || shard.index > shard.count) {
    throw OptionsError({"--shard: '" + text + "' is not allowed, must be I/N with 1 <= I <= N, as in 1/4"});
  }
  return shard;
}

bool isBag(const std::string& path) {
  for (const char* end : {".bag", ".bag.active"}) {
    const std::string suffix = end;
    if (path.size() > suffix.size() && path.compare(path.size() - suffix.size(), suffix.size(), suffix) == 0)
      return true;
  }
  return false;
}

/// One row to come.
struct Item {
  std::size_t input = 0;  ///< place in the list of inputs
  std::size_t scan = 0;   ///< of the bag, from 1; 0: a file, or a bag as a whole
  std::string reason;     ///< why there is nothing to predict; else empty
};

class Batch {
 public:
  Batch(const Arguments& arguments, std::vector<std::string> inputs, const Configuration& configuration)
      : arguments_(arguments),
        inputs_(std::move(inputs)),
        configuration_(configuration),
        predictor_(configuration),
        ahead_(configuration.scan, fileOptions(arguments)) {
    for (std::size_t input = 0; input < inputs_.size(); ++input) list(input);
  }

  std::size_t size() const { return items_.size(); }
  /// Which rows will be asked for, in this order: their files are read ahead.
  void expect(const std::vector<std::size_t>& numbers, std::size_t first) {
    std::vector<std::string> paths;
    for (std::size_t i = first; i < numbers.size(); ++i) {
      const Item& item = items_[numbers[i] - 1];
      if (item.scan == 0 && item.reason.empty()) paths.push_back(inputs_[item.input]);
    }
    ahead_.expect(std::move(paths));
  }

  bool hasDevice() const { return configuration_.device.isStated(); }

  /// @param number from 1 @param failed whether there is no prediction
  RowFields row(std::size_t number, bool& failed) {
    const Item& item = items_[number - 1];
    ScanOrigin origin;
    origin.number = number;
    origin.file = inputs_[item.input];
    origin.scan = item.scan;
    std::string reason = item.reason;
    RowFields figures;
    if (reason.empty()) {
      try {
        figures = predict(item, origin);
      } catch (const std::exception& error) {
        reason = error.what();
        if (reason.empty()) reason = "unknown error";
      }
    }
    failed = !reason.empty();
    RowFields fields = originFields(origin, reason);
    fields.insert(fields.end(), figures.begin(), figures.end());
    if (!failed && !arguments_.dump.empty()) {
      std::ostringstream folder;
      folder << arguments_.dump << "/" << std::setw(6) << std::setfill('0') << number;
      writeFullResult(folder.str(), fields, prepared_.surfaces.lower, prediction_);
    }
    return fields;
  }

 private:
  static ScanFileOptions fileOptions(const Arguments& arguments) {
    ScanFileOptions options;
    options.import.use_cache = !arguments.no_cache;
    options.import.ignore_mask = arguments.ignore_mask;
    return options;
  }

  void list(std::size_t input) {
    if (!isBag(inputs_[input])) {
      items_.push_back({input, 0, ""});
      return;
    }
    try {
      const ScanBagReader& bag = open(input);
      for (std::size_t scan = 1; scan <= bag.count(); ++scan) items_.push_back({input, scan, ""});
      if (bag.wasCutOff()) {
        items_.push_back({input, 0,
                          "the bag was cut off; the " + std::to_string(bag.count()) +
                              " scans before the cut have their rows, what came later is lost"});
      }
    } catch (const std::exception& error) {
      items_.push_back({input, 0, error.what()});
    }
  }

  const ScanBagReader& open(std::size_t input) {
    if (!bag_ || bag_input_ != input) {
      bag_.reset();
      bag_ = std::make_unique<ScanBagReader>(inputs_[input], arguments_.topic, configuration_.scan);
      bag_input_ = input;
    }
    return *bag_;
  }

  RowFields predict(const Item& item, ScanOrigin& origin) {
    HeightMap counter_surface;
    std::vector<std::string> warnings;
    if (item.scan == 0) {
      const ScanFile file = ahead_.take(inputs_[item.input]);
      surface_ = file.surface;
      warnings = file.notes;
      origin.channel = file.channel;
    } else {
      const bool wants_counter = configuration_.counter_surface.type == CounterSurfaceType::kTopic;
      const BagScan of_bag = open(item.input).read(item.scan - 1, wants_counter);
      surface_ = of_bag.scan.surface;
      if (of_bag.counter_surface) counter_surface = of_bag.counter_surface->surface;
      origin.name = of_bag.scan.header.frame_id;
      std::ostringstream stamp;
      stamp << of_bag.scan.header.stamp;
      origin.stamp = stamp.str();
    }
    predictor_.preparer().setMeasuredCounterSurface(counter_surface);
    prepared_ = predictor_.preparer().prepare(surface_);
    prediction_ = predictor_.predict(prepared_);
    std::optional<Verdict> verdict;
    if (hasDevice()) {
      verdict = verdictOf(prediction_, configuration_.device, configuration_.uncertainty, configuration_.model,
                          surface_.cellArea());
    }
    for (const std::string& warning : scanWarnings(surface_)) warnings.push_back(warning);
    return figureFields(surface_, warnings, prediction_, verdict);
  }

  const Arguments& arguments_;
  std::vector<std::string> inputs_;
  const Configuration& configuration_;
  ScanPredictor predictor_;
  ScansAhead ahead_;
  std::vector<Item> items_;
  std::unique_ptr<ScanBagReader> bag_;  ///< the one that was opened last
  std::size_t bag_input_ = 0;
  HeightMap surface_;      ///< as it was read
  PreparedScan prepared_;  ///< and what belongs to it, for the full result
  Prediction prediction_;
};

std::vector<std::string> inputsOf(const Arguments& arguments) {
  std::vector<std::string> inputs = arguments.inputs;
  if (!arguments.input_list.empty()) {
    std::ifstream stream(arguments.input_list);
    if (!stream) throw FileError(arguments.input_list + ": cannot be read");
    for (std::string line; std::getline(stream, line);) {
      if (!line.empty()) inputs.push_back(line);
    }
  }
  if (inputs.empty()) throw OptionsError({"INPUT: no bag and no scan file is given"});
  return inputs;
}

/// What must be the same for rows to stand in one file. Shards have the same.
std::string settingsText(const Batch& batch, const std::vector<std::string>& inputs, const Arguments& arguments,
                         const Configuration& configuration) {
  YAML::Emitter emitter;
  emitter << YAML::BeginMap << YAML::Key << "version" << YAML::Value << YAML::DoubleQuoted << MEMS_STICTION_VERSION;
  emitter << YAML::Key << "opencv_version" << YAML::Value << YAML::DoubleQuoted << CV_VERSION;
  emitter << YAML::Key << "total" << YAML::Value << batch.size();
  emitter << YAML::Key << "topic" << YAML::Value << YAML::DoubleQuoted << arguments.topic;
  if (arguments.ignore_mask) emitter << YAML::Key << "ignore_mask" << YAML::Value << true;
  emitter << YAML::Key << "inputs" << YAML::Value << YAML::BeginSeq;
  for (const std::string& input : inputs) emitter << YAML::DoubleQuoted << input;
  emitter << YAML::EndSeq << YAML::Key << "units" << YAML::Value << YAML::BeginMap;
  for (const auto& [name, unit] : columnUnits(batch.hasDevice())) {
    emitter << YAML::Key << name << YAML::Value << YAML::DoubleQuoted << unit;
  }
  emitter << YAML::EndMap << YAML::EndMap;
  std::string text = "# What the rows beside this file were made with.\n" + std::string(emitter.c_str());
  text += "\nconfiguration:\n";
  std::istringstream lines(toYaml(configuration));
  for (std::string line; std::getline(lines, line);) text += line.empty() ? "\n" : "  " + line + "\n";
  return text;
}

/// Rows of other settings must not mix with these. @throw FileError
void checkSettings(const std::string& path, const std::string& settings) {
  const std::string settings_path = settingsPathOf(path);
  if (std::ifstream(settings_path)) {
    if (readWhole(settings_path) != settings) {
      throw FileError(path + ": holds rows of other inputs, settings or another version (" + settings_path +
                      "): give the same ones to go on, or write another file");
    }
    return;
  }
  if (std::ifstream(path) && !readWhole(path).empty()) {
    throw FileError(path + ": exists, and " + settings_path + ", which says what it was made with, is missing");
  }
  writeFile(settings_path, settings);
}

Configuration configurationOf(const Arguments& arguments) {
  Configuration configuration;
  if (!arguments.configuration.empty()) configuration = loadConfiguration(arguments.configuration);
  if (arguments.voltage) configuration.model.load.voltage = *arguments.voltage;
  if (arguments.load) configuration.model.load.mechanical_load = *arguments.load;
  configuration.check();
  return configuration;
}

int run(const Arguments& arguments) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // we name what is wrong ourselves
  if (arguments.clear_cache) clearImportCache();
  const Shard shard = shardOf(arguments.shard);
  const RowFormat format = rowFormatOf(arguments.output);
  const std::vector<std::string> inputs = inputsOf(arguments);
  Configuration configuration = configurationOf(arguments);
  OutputOptions& output = configuration.model.output;
  output = OutputOptions{};  // figures do not depend on it
  output.deformed_surfaces = output.contact_map = output.energy_curve = !arguments.dump.empty();
  const OutputOptions wanted = output;
  output.energy_curve = output.deformed_surfaces = output.contact_map = false;
  const Configuration stated = configuration;  // the same settings with and without --dump
  output = wanted;

  Batch batch(arguments, inputs, configuration);
  const std::vector<std::string> columns = columnNames(batch.hasDevice());
  checkSettings(arguments.output, settingsText(batch, inputs, arguments, stated));
  std::vector<std::size_t> numbers;
  for (std::size_t number = shard.index; number <= batch.size(); number += shard.count) numbers.push_back(number);

  RowFile rows(arguments.output, format, headingText(format, columns), numbers);
  const std::size_t before = rows.done();
  batch.expect(numbers, before);
  std::size_t failed_count = 0;
  {
    ProgressBar progress(numbers.size(), before);
    while (rows.done() < numbers.size()) {
      progress.show(rows.done(), failed_count);
      bool failed = false;
      rows.append(rowText(batch.row(numbers[rows.done()], failed), format, columns));
      if (failed) ++failed_count;
    }
  }
  std::cout << arguments.output << ": " << rows.done() << " rows, " << before << " of them from before, "
            << failed_count << " scans failed in this run\n";
  return 0;
}

int merge(const Arguments& arguments) {
  const std::vector<std::string> shards = inputsOf(arguments);
  rowFormatOf(arguments.output);
  const std::string settings = readWhole(settingsPathOf(shards.front()));
  for (const std::string& shard : shards) {
    if (readWhole(settingsPathOf(shard)) != settings) {
      throw FileError(shard + ": made with other inputs or settings than " + shards.front());
    }
  }
  const auto total = YAML::Load(settings)["total"].as<std::size_t>();
  mergeRows(shards, arguments.output, total);
  writeFile(settingsPathOf(arguments.output), settings);
  std::cout << arguments.output << ": " << total << " rows of " << shards.size() << " shards\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram<Arguments>("stiction_batch", argc, argv, describe, [](const Arguments& arguments) {
    return arguments.merge ? merge(arguments) : run(arguments);
  });
}
