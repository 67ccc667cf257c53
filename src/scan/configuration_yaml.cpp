#include "mems_stiction/scan/configuration_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/yaml_trouble.hpp"

namespace mems_stiction {

Configuration configurationFromYaml(const YAML::Node& tree, const Configuration& defaults) {
  Configuration configuration = defaults;
  std::vector<std::string> violations =
      readYaml(tree, [&configuration](OptionVisitor& visitor) { configuration.describe(visitor); });
  // Combinations of settings; ranges are found by both and named once.
  for (const std::string& line : configuration.validate()) {
    if (std::find(violations.begin(), violations.end(), line) == violations.end()) violations.push_back(line);
  }
  if (!violations.empty()) throw OptionsError(std::move(violations));
  return configuration;
}

Configuration loadConfiguration(const std::string& path, const Configuration& defaults) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw FileError(path + ": is a folder, not a configuration file");
  YAML::Node tree;
  try {
    tree = YAML::LoadFile(path);
  } catch (const YAML::BadFile&) {
    throw FileError(path + ": the configuration file cannot be opened");
  } catch (const YAML::Exception& error) {
    throw FileError(path + ": " + yamlTroubleOfFile(path, error.what()));
  }
  try {
    return configurationFromYaml(tree, defaults);
  } catch (const OptionsError& error) {
    std::vector<std::string> lines;
    for (const std::string& line : error.violations()) lines.push_back(path + ": " + line);
    throw OptionsError(std::move(lines));
  }
}

std::string toYaml(const Configuration& configuration) {
  Configuration copy = configuration;
  return toYaml([&copy](OptionVisitor& visitor) { copy.describe(visitor); });
}

}  // namespace mems_stiction
