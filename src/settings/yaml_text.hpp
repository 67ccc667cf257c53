#pragma once

/// @file
/// YAML that somebody else has written, parsed with limits. Anchors and aliases let a text of a few
/// bytes contain itself, or stand for more than any memory holds. Both are refused before a tree is
/// built.
///
///     const YAML::Node tree = parseYaml(readInput(path, kSettingsInput), path);

#include <string>

namespace YAML {
class Node;
}

namespace mems_stiction {

/// Levels of maps and lists below one another. Settings have four.
constexpr int kMaxYamlDepth = 32;

/// The first document of a text as a tree; null if there is none.
/// - @p name that the error begins with, as of the file
/// @throw FileError in one line for a text
/// - that is binary, or not valid YAML (the error names a line that begins with a tab, which nobody
/// sees);
/// - that contains itself, or has more than kMaxYamlDepth levels;
/// - whose aliases stand for more than 10'000 values, or 1 MB, and for more than the text itself
/// has.
YAML::Node parseYaml(const std::string& text, const std::string& name);

}  // namespace mems_stiction
