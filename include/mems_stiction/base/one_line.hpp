#pragma once

/// @file
/// A text of several lines on one, for logs, records and people who count lines.

#include <cstdio>
#include <string>

namespace mems_stiction {

/// Line ends become "; ", other control characters "\\x1b" and the like: no text can move the cursor, hide what was said
/// before, or begin a line of its own.
inline std::string oneLine(const std::string& text) {
  std::string line;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == '\n' || letter == '\r') {
      line += "; ";
    } else if (byte < 0x20 || byte == 0x7F) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\x%02x", static_cast<unsigned>(byte));
      line += escaped;
    } else {
      line += letter;
    }
  }
  return line;
}

}  // namespace mems_stiction
