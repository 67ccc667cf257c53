#pragma once

/// @file
/// Which readers these are: what older ones made of a file must not pass for what these make of it.

#include <string>

namespace mems_stiction {

/// Digits that change with every change in the code of this room.
std::string readerVersion();

}  // namespace mems_stiction
