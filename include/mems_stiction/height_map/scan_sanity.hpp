#pragma once

/// @file
/// Does a scan look like what it claims to be? A wrong unit is the commonest mistake, and it gives no error: only a
/// prediction that is wrong by powers of ten.

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// One line for each of these, naming the value and the likely slip of units; empty for a plausible scan:
/// - a pitch outside 1 pm .. 1 mm
/// - a range of heights above the scan's width
/// - float32 heights (in a double map too, if every height is exactly a float32) whose spacing exceeds a tenth of their
///   rms height: a stage offset has swallowed the roughness.
std::vector<std::string> scanWarnings(const HeightMap& scan);

}  // namespace mems_stiction
