#pragma once

/// Texts in the cells of CSV files.

#include <cstring>
#include <string>

namespace mems_stiction {

/// The text as a cell: quoted where it must be, and with an apostrophe before what a spreadsheet
/// would take for the beginning of a formula.
inline std::string csvText(std::string text) {
  if (!text.empty() && std::strchr("=+-@\t", text.front()) != nullptr) text.insert(0, "'");
  if (text.find_first_of("\",") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

}  // namespace mems_stiction
