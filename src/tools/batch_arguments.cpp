#include "batch_arguments.hpp"

#include <climits>
#include <sstream>

#include "command_line.hpp"
#include "configuration/named_files.hpp"
#include "evaluation/row_columns.hpp"
#include "files/input_file.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr InputKind kInputList = {"a list of inputs", 100'000'000, true};

constexpr unsigned kMostWorkers = 1024;

}  // namespace

void describe(CLI::App& app, BatchArguments& arguments) {
  app.description(
      "Predicts every scan of many bags and scan files and writes one row for each, in SI units, "
      "with the field names\n"
      "of mems_stiction/StictionPrediction. Called again after an interruption it goes on where it "
      "was. A scan that\n"
      "cannot be predicted is a row whose message says why.");
  app.add_option("INPUT", arguments.inputs,
                 "bags, and scan files of every kind that predict_scan reads")
      ->type_name("");
  app.add_option("--inputs-from", arguments.input_list, "a file with one more INPUT on each line")
      ->type_name("FILE");
  app.add_option("-o,--output", arguments.output,
                 "the rows; beside them OUT.settings.yaml, what they were made with")
      ->required()
      ->type_name("OUT.csv|OUT.jsonl");
  app.add_option("--columns", arguments.form.columns,
                 "OUT has these columns and groups of them, with commas between, or all; the rows "
                 "with which a call goes on are then in OUT.rows.csv. Groups: " +
                     columnGroupsText())
      ->type_name("NAMES");
  app.add_flag("--excel", arguments.form.is_for_excel,
               "OUT is for a spreadsheet whose decimal sign is the comma: semicolons between "
               "cells; without --columns it has every column that some row has a value for");
  app.add_option("-c,--config", arguments.configuration,
                 "every key is explained in config/stiction.yaml")
      ->type_name("FILE.yaml");
  addLoadOptions(app, arguments);
  app.add_flag(
      "--half-space", arguments.half_space,
      "columns half_space_... too: each scan as one elastic half-space, as half_space/enabled true "
      "does, "
      "seconds to minutes each, doc/half_space.md; half_space_message says what has no solution, "
      "and why. Without "
      "it the columns are there where a device is stated, for scans whose flags ask for it");
  auto* const own_force = app.add_flag(
      "--device-force", arguments.device_force,
      "each row's verdict rests on the device's own force by that scan alone, as that of "
      "predict_scan does, seconds "
      "each. It does so without --parts, which finds the force by all scans of a part");
  app.add_flag("--no-device-force", arguments.no_device_force,
               "a scan stands for contacts of its size alone")
      ->excludes(own_force);
  app.add_option("-s,--shard", arguments.shard,
                 "part I of N parts of about the same number of scans")
      ->type_name("I/N")
      ->capture_default_str();
  app.add_option("--workers", arguments.workers,
                 "scans that are predicted side by side, each on a thread")
      ->type_name("N")
      ->check(CLI::Range(1U, kMostWorkers))
      ->capture_default_str();
  app.add_flag(
      "-m,--merge", arguments.merge,
      "INPUTs are the rows of all shards: joins them to what one run writes, byte for byte");
  app.add_option("--parts", arguments.parts,
                 "also write a row for each part: the scans of one part_id and serial_id, pooled "
                 "to one verdict; with "
                 "--merge of all shards")
      ->type_name("PARTS.csv|PARTS.jsonl");
  app.add_option(
         "--part", arguments.part,
         "the part of all scans that state none: they are of one device. Goes before part/id")
      ->type_name("NAME");
  app.add_option(
         "-d,--dump", arguments.dump,
         "also write surfaces, contacts and curves of each scan into FOLDER/NUMBER (.npy and JSON)")
      ->type_name("FOLDER");
  app.add_option("--topic", arguments.topic,
                 "of the scans in bags; scan_info is looked for beside it")
      ->capture_default_str();
  addMaskOption(app, arguments.ignore_mask);
  addPlausibilityOptions(app, arguments);
  app.footer(
      "Exit status: 0 every scan has its row (the last line says how many failed), 1 so it has, "
      "but no scan of this "
      "call\n"
      "could be predicted, or with --strict that a row has a warning, 2 bad input.\n\n"
      "Example: stiction_batch --config device.yaml --shard 1/2 -o part1.csv 2026-*.bag   # and "
      "2/2 elsewhere\n"
      "         stiction_batch --merge -o all.csv part1.csv part2.csv");
}

ScanFileOptions fileOptions(const BatchArguments& arguments) {
  ScanFileOptions options;
  options.import.ignore_mask = arguments.ignore_mask;
  return options;
}

Shard shardOf(const std::string& text) {
  Shard shard;
  char slash = 0;
  std::istringstream stream(text);
  if (text.find('-') != std::string::npos || !(stream >> shard.index >> slash >> shard.count) ||
      slash != '/' || stream.peek() != EOF || shard.index < 1 || shard.index > shard.count) {
    throw OptionsError(
        {"--shard: '" + text + "' is not allowed, must be I/N with 1 <= I <= N, as in 1/4"});
  }
  return shard;
}

std::vector<std::string> inputsOf(const BatchArguments& arguments) {
  std::vector<std::string> inputs = arguments.inputs;
  if (!arguments.input_list.empty()) {
    const std::string text = readInput(arguments.input_list, kInputList);
    // Lists made elsewhere begin with a byte order mark, and end their lines with CR LF.
    const std::size_t start = startsWith(text, "\xEF\xBB\xBF") ? 3 : 0;
    const bool is_text = text.find('\0') == std::string::npos;
    std::istringstream stream(text.substr(start));
    for (std::string line; std::getline(stream, line);) {
      if (endsWith(line, "\r")) line.pop_back();
      if (!is_text || line.size() >= PATH_MAX)
        throw FileError(arguments.input_list + ": is no list with an INPUT on each line");
      if (line.find_first_not_of(" \t") != std::string::npos) inputs.push_back(line);
    }
  }
  if (inputs.empty()) throw OptionsError({"INPUT: no bag and no scan file is given"});
  return scansOf(inputs);
}

Configuration configurationOf(const BatchArguments& arguments) {
  Configuration configuration =
      configurationFile(arguments.configuration, arguments.accept_implausible);
  applyLoads(arguments, configuration.model.load);
  if (!arguments.part.empty()) configuration.part.id = arguments.part;
  if (arguments.half_space) configuration.half_space.enabled = HalfSpaceUse::kAlways;
  configuration.check();
  return withFilesOfNow(std::move(configuration));
}

}  // namespace mems_stiction
