#include "errors/one_line.hpp"

#include <algorithm>
#include <cstdio>

namespace mems_stiction {
namespace {

/// How many bytes the letter of UTF-8 has that begins at `place`; 0: none begins there.
std::size_t letterSize(const std::string& text, std::size_t place) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(place);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t size = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(place + i) & 0xC0U) != 0x80) return 0;
  }
  // Not those that fewer bytes would do for, surrogates, and what is beyond U+10FFFF.
  const unsigned second = byte(place + 1);
  const bool is_wrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
                        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90);
  return is_wrong ? 0 : size;
}

bool isControl(const std::string& text, std::size_t place, std::size_t size) {
  const auto first = static_cast<unsigned char>(text[place]);
  if (size == 1) return first < 0x20 || first == 0x7F;
  return size == 2 && first == 0xC2 && static_cast<unsigned char>(text[place + 1]) < 0xA0;
}

}  // namespace

std::string oneLine(const std::string& text) {
  std::string line;
  for (std::size_t place = 0; place < text.size();) {
    const std::size_t size = letterSize(text, place);
    const std::size_t end = place + std::max<std::size_t>(size, 1);
    if (text[place] == '\n' || text[place] == '\r') {
      line += "; ";
    } else if (size > 0 && !isControl(text, place, size)) {
      line.append(text, place, size);
    } else {
      for (std::size_t i = place; i < end; ++i) {
        char escaped[8];
        std::snprintf(escaped, sizeof escaped, "\\x%02x",
                      static_cast<unsigned>(static_cast<unsigned char>(text[i])));
        line += escaped;
      }
    }
    place = end;
  }
  return line;
}

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80) --end;
  return text.substr(0, end) + "... (" + std::to_string(text.size()) + " bytes)";
}

}  // namespace mems_stiction
