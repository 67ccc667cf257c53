#pragma once

/// @file
/// What is wrong with a text that is no YAML, in words.

#include <string>

namespace mems_stiction {

/// - @p text that was read
/// - @p error what the parser said
/// @return "not valid YAML: ..." with the line that begins with a tab, which YAML does not allow and nobody sees; or that it is no text.
std::string yamlTrouble(const std::string& text, const std::string& error);

}  // namespace mems_stiction
