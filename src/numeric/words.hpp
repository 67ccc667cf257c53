#pragma once

/// @file
/// Words as people write them: letters of either case, blanks around them, slips.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mems_stiction {

/// ASCII letters small; all other bytes as they are.
std::string lowered(std::string text);

/// Without the characters of `around` at both ends.
std::string trimmed(const std::string& text, const std::string& around);

/// Whether these are its first letters.
bool startsWith(std::string_view text, std::string_view start);

/// Whether these are its last letters.
bool endsWith(std::string_view text, std::string_view end);

/// With `with` for every `what`.
std::string replaced(std::string text, const std::string& what, const std::string& with);

/// "1 scan", "2 scans".
/// - @p word of one, whose plural ends in s
std::string countText(std::size_t count, const std::string& word);

/// One after the other, with commas between them.
std::string listed(const std::vector<std::string>& words);

/// Appends the lines that are not there yet.
void addMissing(const std::vector<std::string>& more, std::vector<std::string>& lines);

/// What stands between blanks and line ends.
std::vector<std::string> wordsOf(const std::string& text);

/// What is behind the last slash.
std::string lastPart(const std::string& key);

/// Known words that the unknown one may have meant, as " (did you mean ...?)"; empty if none is
/// near. Words with slashes are near to all that share their last part.
std::string suggestion(const std::string& unknown, const std::vector<std::string>& known);

}  // namespace mems_stiction
