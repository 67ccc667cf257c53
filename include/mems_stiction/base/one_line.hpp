#pragma once

/// @file
/// A text of several lines on one, for logs, records and people who count lines.

#include <string>

namespace mems_stiction {

inline std::string oneLine(std::string text) {
  for (std::size_t at = text.find_first_of("\r\n"); at != std::string::npos; at = text.find_first_of("\r\n", at)) {
    text.replace(at, 1, "; ");
  }
  return text;
}

}  // namespace mems_stiction
