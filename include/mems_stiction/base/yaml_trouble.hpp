#pragma once

/// @file
/// What is wrong with a text that is no YAML, in words.

#include <string>

namespace mems_stiction {

/// - @p text of the file; may be empty where it is not known
/// - @p error what the parser said
/// @return "not valid YAML: ..." with the line that begins with a tab, which YAML does not allow and nobody sees; or that it is no text.
std::string yamlTrouble(const std::string& text, const std::string& error);

/// The same of a file, whose text is read for it.
std::string yamlTroubleOfFile(const std::string& path, const std::string& error);

}  // namespace mems_stiction
