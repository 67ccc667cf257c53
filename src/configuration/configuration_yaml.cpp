#include "mems_stiction/configuration/configuration_yaml.hpp"

#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <utility>

#include "configuration/named_files.hpp"
#include "files/input_file.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "settings/option_yaml.hpp"
#include "settings/yaml_text.hpp"

namespace mems_stiction {

Configuration configurationFromYaml(const YAML::Node& tree, const Configuration& defaults) {
  Configuration configuration = defaults;
  std::vector<std::string> violations =
      readYaml(tree, [&configuration](OptionVisitor& visitor) { configuration.describe(visitor); });
  // Combinations of settings; ranges are found by both and named once.
  addMissing(configuration.validate(), violations);
  if (!violations.empty()) throw OptionsError(std::move(violations));
  return configuration;
}

Configuration loadConfiguration(const std::string& path, const Configuration& defaults) {
  if (access(path.c_str(), R_OK) != 0)
    throw FileError(path + ": the configuration file cannot be opened");
  const YAML::Node tree = parseYaml(readInput(path, kSettingsInput), path);
  try {
    Configuration configuration = configurationFromYaml(tree, defaults);
    const std::filesystem::path here = std::filesystem::current_path();
    placeNamedFiles(keysOf(tree),
                    isOpenStream(path) ? here : here / std::filesystem::path(path).parent_path(),
                    configuration);
    if (path == "/dev/null") return configuration;  // whoever writes that means the defaults
    for (const std::string& line : emptyPartsOf(tree))
      configuration.remarks.push_back(path + ": " + line);
    return configuration;
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
