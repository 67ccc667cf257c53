#pragma once

/// @file
/// A text of several lines on one, for logs, records and people who count lines.

#include <cstdio>
#include <string>

namespace mems_stiction {

/// Line ends become "; ", other control characters "\\x1b" and the like, those of two bytes in UTF-8 (U+0080 to U+009F, which
/// terminals obey too) "\\xc2\\x9b": no text can move the cursor, hide what was said
/// before, or begin a line of its own.
inline std::string oneLine(const std::string& text) {
  std::string line;
  unsigned char before = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    const auto byte = static_cast<unsigned char>(letter);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    const bool begins_control = byte == 0xC2 && next >= 0x80 && next < 0xA0;
    // 0x80 to 0x9F continue other letters of UTF-8; alone they are controls of one byte
    const bool is_control = byte < 0x20 || byte == 0x7F || begins_control ||
                            (byte >= 0x80 && byte < 0xA0 && (before < 0x80 || before == 0xC2));
    before = byte;
    if (letter == '\n' || letter == '\r') {
      line += "; ";
    } else if (is_control) {
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
