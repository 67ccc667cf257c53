#pragma once

/// @file
/// Numbers in text: with a decimal point whatever locale the process runs in.

#include <cstddef>
#include <string>

namespace mems_stiction {

/// Where the number that begins at `at` ends: digits, point and exponent ("e" or Fortran's "D"), or "nan" and "inf" in any case. The same
/// position if there is none.
std::size_t numberEnd(const std::string& text, std::size_t at);

/// Value of a text that is a number as a whole. @throw FileError without a file name, with the text, if it is none or
/// too large for a double.
double plainNumber(const std::string& text);

/// A word that stands for a number that was not measured: "N/A", "BAD", "---" and others, in any case.
bool isMissingWord(const std::string& text);

/// A short piece of a text for a message: control characters as "?".
std::string shownPiece(const std::string& text, std::size_t at = 0);

}  // namespace mems_stiction
