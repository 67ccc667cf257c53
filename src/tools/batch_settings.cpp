#include "batch_settings.hpp"

#include <filesystem>
#include <sstream>

#include <yaml-cpp/yaml.h>
#include <opencv2/core/version.hpp>

#include "batch_rows.hpp"
#include "files/output_file.hpp"
#include "import/format_readers.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "settings/yaml_text.hpp"

namespace mems_stiction {

std::string settingsText(std::size_t total, const std::vector<std::string>& inputs,
                         const BatchArguments& arguments,
                         const std::map<std::string, std::string>& units,
                         const Configuration& configuration) {
  YAML::Emitter emitter;
  emitter << YAML::BeginMap << YAML::Key << "version" << YAML::Value << YAML::DoubleQuoted
          << packageVersion();
  emitter << YAML::Key << "readers" << YAML::Value << YAML::DoubleQuoted << readerVersion();
  emitter << YAML::Key << "settings_hash" << YAML::Value << YAML::DoubleQuoted
          << settingsHash(configuration);
  emitter << YAML::Key << "opencv_version" << YAML::Value << YAML::DoubleQuoted << CV_VERSION;
  emitter << YAML::Key << "total" << YAML::Value << total;
  emitter << YAML::Key << "topic" << YAML::Value << YAML::DoubleQuoted << arguments.topic;
  if (arguments.rowsHaveDeviceForce())
    emitter << YAML::Key << "device_force" << YAML::Value << true;
  if (arguments.ignore_mask) emitter << YAML::Key << "ignore_mask" << YAML::Value << true;
  emitter << YAML::Key << "inputs" << YAML::Value << YAML::BeginSeq;
  for (const std::string& input : inputs) emitter << YAML::DoubleQuoted << input;
  emitter << YAML::EndSeq << YAML::Key << "units" << YAML::Value << YAML::BeginMap;
  for (const auto& [name, unit] : units) {
    emitter << YAML::Key << name << YAML::Value << YAML::DoubleQuoted << unit;
  }
  emitter << YAML::EndMap << YAML::EndMap;
  std::string text =
      "# What the rows beside this file were made with.\n" + std::string(emitter.c_str());
  text += "\nconfiguration:\n";
  std::istringstream lines(toYaml(configuration));
  for (std::string line; std::getline(lines, line);)
    text += line.empty() ? "\n" : "  " + line + "\n";
  return text;
}

std::string comparableSettings(const std::string& settings) {
  std::string text;
  std::istringstream lines(settings);
  for (std::string line; std::getline(lines, line);) {
    if (startsWith(line, "settings_hash:")) continue;
    const std::size_t path = line.find("file: \"");
    const std::size_t end = line.find("\"  # ");
    const bool names_file =
        startsWith(line, "    ") && path != std::string::npos && end != std::string::npos;
    if (names_file) line = line.substr(0, path) + line.substr(line.find_last_of("\"/", end - 1));
    text += line + "\n";
  }
  return text;
}

void checkSettings(const std::string& path, const std::string& settings) {
  const std::string settings_path = settingsPathOf(path);
  std::error_code ignored;
  if (std::filesystem::exists(settings_path, ignored)) {
    const std::string before = readSettings(path);
    if (comparableSettings(before) != comparableSettings(settings)) {
      throw FileError(path + ": holds rows of other inputs, settings or another version (" +
                      settings_path + "): give the same ones to go on, or write another file");
    }
    if (before != settings) writeFile(settings_path, settings);
    return;
  }
  if (hasRows(path)) {
    throw FileError(path + ": exists, and " + settings_path +
                    ", which says what it was made with, is missing");
  }
  writeFile(settings_path, settings);
}

Configuration madeOf(const std::string& path, const std::string& settings,
                     BatchArguments& arguments) {
  try {
    const YAML::Node tree = parseYaml(settings, settingsPathOf(path));
    arguments.inputs = tree["inputs"].as<std::vector<std::string>>();
    arguments.topic = tree["topic"].as<std::string>();
    arguments.ignore_mask = tree["ignore_mask"].as<bool>(false);
    return configurationFromYaml(tree["configuration"]);
  } catch (const YAML::Exception& error) {
    throw FileError(settingsPathOf(path) +
                    ": damaged, it does not say what the rows were made of: " + error.what());
  }
}

std::size_t totalOf(const std::string& path, const std::string& settings) {
  try {
    return parseYaml(settings, settingsPathOf(path))["total"].as<std::size_t>();
  } catch (const YAML::Exception& error) {
    throw FileError(settingsPathOf(path) +
                    ": damaged, it does not say how many rows there are: " + error.what());
  }
}

}  // namespace mems_stiction
