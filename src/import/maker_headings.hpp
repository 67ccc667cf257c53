#pragma once

/// @file
/// Headings of text exports whose entries have a unit or an order of their own: Wyko, Keyence,
/// SPIP, Attocube, Nova.

#include <optional>
#include <vector>

#include "import/text_header.hpp"
#include "import/text_lines.hpp"

namespace mems_stiction {

/// None if the heading is by none of these programs.
/// @throw FileError without a file name for entries that contradict each other or are no numbers or
/// lengths
std::optional<TextHeader> makerHeading(const std::vector<TextLine>& heading);

}  // namespace mems_stiction
