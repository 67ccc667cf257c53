#pragma once

/// @file
/// What an exception says, in words for those who did not write the program.

#include <exception>
#include <new>
#include <string>

namespace mems_stiction {

/// what(), or what is behind it where that are no words: memory that is not to be had, no text at
/// all.
inline std::string reasonOf(const std::exception& error) {
  const std::string text = error.what();
  const bool has_no_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
                             text.find("Failed to allocate") != std::string::npos;
  if (has_no_memory) return "there is not enough memory for a scan of this size";
  return text.empty() ? "unknown error" : text;
}

}  // namespace mems_stiction
