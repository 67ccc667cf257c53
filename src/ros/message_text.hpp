#pragma once

/// @file
/// Texts as messages carry them: `rostopic echo -p` puts commas between fields and no marks around texts.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace mems_stiction {

/// Semicolons in the place of commas.
inline std::string withoutCommas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

inline std::vector<std::string> withoutCommas(std::vector<std::string> texts) {
  for (std::string& text : texts) text = withoutCommas(std::move(text));
  return texts;
}

}  // namespace mems_stiction
