#pragma once

/// @file
/// What an exception says, in words for those who did not write the program.

#include <exception>
#include <new>
#include <string>

namespace mems_stiction {

/// Whether memory was not to be had, by the exception of C++ or of OpenCV.
inline bool hasNoMemory(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         std::string(error.what()).find("Failed to allocate") != std::string::npos;
}

/// what(), or what is behind it where that are no words: memory that is not to be had, no text at
/// all.
inline std::string reasonOf(const std::exception& error) {
  const std::string text = error.what();
  if (hasNoMemory(error)) return "there is not enough memory for a scan of this size";
  return text.empty() ? "unknown error" : text;
}

}  // namespace mems_stiction
