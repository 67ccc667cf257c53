#pragma once

/// The picture of a device's force, which the script plot_device draws.

#include <string>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// - @p record of deviceJsonRecord()
/// - @p made_surface of the record's force; may be empty
/// @throw FileError if it cannot be drawn, with what the script says
void drawDevice(const std::string& record, const HeightMap& made_surface, const std::string& path);

}  // namespace mems_stiction
