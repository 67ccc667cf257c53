#pragma once

/// @file
/// Constants that are allowed, but that no material, device or instrument is likely to have: slips of a unit. A modulus of
/// 169 is 169 GPa, a hundred metres of insulator are 100 nm.

#include <string>
#include <vector>

#include "mems_stiction/scan/configuration.hpp"

namespace mems_stiction {

/// One sentence for each stated constant outside what is usual, with the unit that was probably meant; empty when all is
/// well. Zeros say "not stated".
std::vector<std::string> settingsWarnings(const Configuration& configuration);

}  // namespace mems_stiction
