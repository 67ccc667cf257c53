#pragma once

/// What stiction_batch is told.

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "chosen_table.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/import/scan_file.hpp"

namespace mems_stiction {

struct BatchArguments {
  std::string configuration;
  std::optional<double> voltage;
  std::optional<double> load;
  std::string shard = "1/1";
  std::string output;  ///< the rows
  TableForm form;
  std::string table;  ///< of that form, beside the rows; empty if there is none
  std::string parts;
  std::string part;
  std::string dump;
  std::string topic = "height";
  std::string input_list;
  unsigned workers = 1;
  bool half_space = false;
  bool device_force = false;
  bool no_device_force = false;
  bool merge = false;
  bool ignore_mask = false;
  bool accept_implausible = false;
  bool strict = false;
  std::vector<std::string> inputs;

  /// Whether each row finds the device's own force by its scan alone; with --parts the parts have
  /// it.
  bool rowsHaveDeviceForce() const { return device_force || (parts.empty() && !no_device_force); }
};

void describe(CLI::App& app, BatchArguments& arguments);

/// Part `index` of `count` parts.
struct Shard {
  std::size_t index = 1, count = 1;
};

/// @throw OptionsError
Shard shardOf(const std::string& text);

/// How files are read.
ScanFileOptions fileOptions(const BatchArguments& arguments);

/// INPUTs of the command line and of its list. @throw FileError, OptionsError
std::vector<std::string> inputsOf(const BatchArguments& arguments);

/// The configuration file with the command line's values in it. @throw FileError, OptionsError
Configuration configurationOf(const BatchArguments& arguments);

}  // namespace mems_stiction
