#pragma once

/// @file
/// Words as people write them: letters of either case, blanks around them, slips.

#include <string>
#include <vector>

namespace mems_stiction {

/// ASCII letters small; all other bytes as they are.
std::string lowered(std::string text);

/// Without the characters of `around` at both ends.
std::string trimmed(const std::string& text, const std::string& around);

/// Whether these are its last letters.
bool endsWith(const std::string& text, const std::string& end);

/// What is behind the last slash.
std::string lastPart(const std::string& key);

/// Known words that the unknown one may have meant, as " (did you mean ...?)"; empty if none is near. Words with slashes
/// are near to all that share their last part.
std::string suggestion(const std::string& unknown, const std::vector<std::string>& known);

}  // namespace mems_stiction
