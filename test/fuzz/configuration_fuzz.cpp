/// The text of a configuration file. What is accepted is written out and reads back as the same
/// settings.

#include <string>

#include <yaml-cpp/yaml.h>

#include "evaluation/plausibility.hpp"
#include "fuzz/fuzzing.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "settings/yaml_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mems_stiction;
  Configuration configuration;
  const auto read = [](const std::string& text) {
    return configurationFromYaml(parseYaml(text, "settings"));
  };
  if (!fuzzing::accepted([&] { configuration = read(fuzzing::textOf(data, size)); })) return 0;
  settingsWarnings(configuration);
  static std::string known = toYaml(Configuration());
  const std::string text = toYaml(configuration);
  if (text == known)
    return 0;  // most inputs change nothing: to write and read takes most of the time
  known = text;
  fuzzing::require(toYaml(read(text)) == text, "settings read back as they were written");
  return 0;
}
