#include "mems_stiction/base/yaml_trouble.hpp"

#include <algorithm>

namespace mems_stiction {
namespace {

/// Number of the first line that begins with a tab, behind spaces or not; 0: none.
std::size_t lineWithTab(const std::string& text) {
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t first = text.find_first_not_of(' ', begin);
    if (first != std::string::npos && text[first] == '\t') return number;
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return 0;
}

bool isBinary(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return code < 0x20 && letter != '\t' && letter != '\n' && letter != '\r';
  });
}

}  // namespace

std::string yamlTrouble(const std::string& text, const std::string& error) {
  if (isBinary(text)) return "is not a text, so no file of settings";
  const std::size_t line = lineWithTab(text);
  if (line == 0) return "not valid YAML: " + error;
  return "not valid YAML: line " + std::to_string(line) + " begins with a tab; must be spaces (" + error + ")";
}

}  // namespace mems_stiction
