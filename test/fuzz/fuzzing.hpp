#pragma once

/// What the programs of this folder share. Each has one input, which somebody else wrote, and asks
/// the code that reads it: under clang's libFuzzer (scripts/fuzz) with inputs without end, in the
/// tests with those of corpus.tar.gz, where CMake gives the function of each a name of its own.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "mems_stiction/errors/errors.hpp"

/// @return 0. A finding is an exception that leaves it, or what a sanitizer ends the program for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace mems_stiction::fuzzing {

/// A statement that holds whatever the input is. @throw std::logic_error that becomes a finding, if
/// it does not
inline void require(bool holds, const char* statement) {
  if (!holds) throw std::logic_error(std::string("does not hold: ") + statement);
}

/// Calls `read`, which may refuse the input by one of the project's own errors, with a reason.
/// @return false if it did; every other exception goes on and becomes a finding
template <typename Function>
bool accepted(Function&& read) {
  try {
    read();
  } catch (const Error& error) {
    require(error.what()[0] != '\0', "an error says why");
    return false;
  }
  return true;
}

inline std::string textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace mems_stiction::fuzzing
