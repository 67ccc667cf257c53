#pragma once

/// @file
/// Headers that state a size or a gain a second time, and otherwise: the programs that read makers'
/// files take one of the two without a word.

#include <string>

namespace mems_stiction {

/// Nanonis (.sxm) and Createc; nothing for all others. Keys without regard to case; what is stated
/// twice alike passes.
/// @throw FileError without a file name, with key and values
void checkStatedTwice(const std::string& bytes);

}  // namespace mems_stiction
