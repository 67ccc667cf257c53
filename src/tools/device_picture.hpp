#pragma once

/// The picture of a device's force, which the script plot_device draws.

#include <string>

namespace mems_stiction {

/// - @p record of deviceJsonRecord()
/// @throw FileError if it cannot be drawn, with what the script says
void drawDevice(const std::string& record, const std::string& path);

}  // namespace mems_stiction
