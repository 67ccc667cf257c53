#include "mems_stiction/configuration/configuration_yaml.hpp"

#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "configuration/named_files.hpp"
#include "files/input_file.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "settings/option_yaml.hpp"
#include "settings/yaml_text.hpp"

namespace mems_stiction {

namespace {

std::vector<std::string> readInto(const YAML::Node& tree, Configuration& configuration) {
  return readYaml(tree,
                  [&configuration](OptionVisitor& visitor) { configuration.describe(visitor); });
}

}  // namespace

Configuration configurationFromYaml(const YAML::Node& tree, const Configuration& defaults) {
  return configurationFromYaml(tree, YAML::Node(), defaults);
}

Configuration configurationFromYaml(const YAML::Node& tree, const YAML::Node& over,
                                    const Configuration& defaults) {
  Configuration configuration = defaults;
  std::vector<std::string> violations = readInto(withoutKeys(tree, keysOf(over)), configuration);
  addMissing(readInto(over, configuration), violations);
  // Combinations of settings; ranges are found by both and named once.
  addMissing(configuration.validate(), violations);
  if (!violations.empty()) throw OptionsError(std::move(violations));
  return configuration;
}

Configuration loadConfiguration(const std::string& path, const Configuration& defaults) {
  return loadConfiguration(path, YAML::Node(), defaults);
}

Configuration loadConfiguration(const std::string& path, const YAML::Node& over,
                                const Configuration& defaults) {
  if (access(path.c_str(), R_OK) != 0)
    throw FileError(path + ": the configuration file cannot be opened");
  const YAML::Node tree = parseYaml(readInput(path, kSettingsInput), path);
  const std::vector<std::string> before = keysOf(over);
  const YAML::Node file = withoutKeys(tree, before);
  try {
    Configuration configuration = configurationFromYaml(file, over, defaults);
    const std::filesystem::path here = std::filesystem::current_path();
    placeNamedFiles(keysOf(file),
                    isOpenStream(path) ? here : here / std::filesystem::path(path).parent_path(),
                    configuration);
    placeNamedFiles(before, here, configuration);
    if (path == "/dev/null") return configuration;  // whoever writes that means the defaults
    for (const std::string& line : emptyPartsOf(tree))
      configuration.remarks.push_back(path + ": " + line);
    return configuration;
  } catch (const OptionsError& error) {
    std::vector<std::string> lines;
    for (const std::string& line : error.violations()) {
      const std::string key = line.substr(0, line.find(": "));
      const bool is_of_others = std::find(before.begin(), before.end(), key) != before.end();
      lines.push_back(is_of_others ? line : path + ": " + line);
    }
    throw OptionsError(std::move(lines));
  }
}

std::string toYaml(const Configuration& configuration) {
  Configuration copy = configuration;
  return toYaml([&copy](OptionVisitor& visitor) { copy.describe(visitor); });
}

}  // namespace mems_stiction
