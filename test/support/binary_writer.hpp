#pragma once

/// Bytes of files that a test describes number by number.

#include <cstdint>
#include <cstring>
#include <string>

namespace mems_stiction {

/// The number in little-endian order.
template <typename Number>
std::string littleBytes(Number number) {
  std::uint64_t bits = 0;
  if constexpr (sizeof(Number) == 8) {
    std::memcpy(&bits, &number, sizeof number);
  } else if constexpr (sizeof(Number) == 4) {
    std::uint32_t narrow = 0;
    std::memcpy(&narrow, &number, sizeof number);
    bits = narrow;
  } else {
    bits = static_cast<std::uint64_t>(number);
  }
  std::string text;
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    text += static_cast<char>(bits >> (8 * i) & 0xFF);
  return text;
}

template <typename Number>
std::string bigBytes(Number number) {
  const std::string little = littleBytes(number);
  return {little.rbegin(), little.rend()};
}

/// A text in a field of fixed width.
inline std::string field(std::string text, std::size_t width, char filler = '\0') {
  text.resize(width, filler);
  return text;
}

}  // namespace mems_stiction
