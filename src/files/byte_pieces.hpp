#pragma once

/// @file
/// Numbers one after another in a string of bytes, for programs on machines of the same order of
/// bytes.

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace mems_stiction {

/// Puts a number behind the others.
template <typename Number>
void appendBytes(std::string& bytes, const Number& number) {
  static_assert(std::is_trivially_copyable<Number>::value, "a number, or a structure of some");
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Takes the first number off the bytes.
/// @return whether there was a whole one; else the number stays as it was
template <typename Number>
bool takeBytes(std::string_view& bytes, Number& number) {
  static_assert(std::is_trivially_copyable<Number>::value, "a number, or a structure of some");
  if (bytes.size() < sizeof number) return false;
  // NOLINTNEXTLINE(bugprone-suspicious-stringview-data-usage): so many bytes are there
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes.remove_prefix(sizeof number);
  return true;
}

}  // namespace mems_stiction
