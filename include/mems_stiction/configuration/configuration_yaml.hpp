#pragma once

/// @file
/// One configuration file or parameter tree into a Configuration, and back. Keys:
/// config/stiction.yaml.
///
///     const Configuration configuration = loadConfiguration("device.yaml");
///     print(toYaml(configuration));

#include <string>

#include "mems_stiction/configuration/configuration.hpp"

namespace YAML {
class Node;
}

namespace mems_stiction {

/// - @p defaults what keys that the tree does not name keep.
/// @throw OptionsError one line per unknown key, wrong type, unphysical value or combination.
Configuration configurationFromYaml(const YAML::Node& tree, const Configuration& defaults = {});
/// The same of two trees; what `over` names goes before `tree`, and only both together are checked.
Configuration configurationFromYaml(const YAML::Node& tree, const YAML::Node& over,
                                    const Configuration& defaults);

/// Relative paths that the file states go by its folder, those of /dev/stdin by the working one.
/// @throw FileError if the file cannot be read or is not YAML; OptionsError as above, each line
/// with the file's name.
Configuration loadConfiguration(const std::string& path, const Configuration& defaults = {});
/// The same with keys that go before those of the file; their paths go by the working folder.
Configuration loadConfiguration(const std::string& path, const YAML::Node& over,
                                const Configuration& defaults);

/// The effective configuration with units and ranges as comments; loads back to the same values.
std::string toYaml(const Configuration& configuration);

}  // namespace mems_stiction
