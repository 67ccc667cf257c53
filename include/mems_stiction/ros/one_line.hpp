#pragma once

/// Errors hold one line per reason; answers and warnings have one line.

#include <string>

namespace mems_stiction {

/// All reasons of one error on one line.
inline std::string oneLine(std::string text) {
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) text.replace(end, 1, "; ");
  return text;
}

}  // namespace mems_stiction
