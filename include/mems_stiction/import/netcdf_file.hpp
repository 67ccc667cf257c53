#pragma once

/// @file
/// Classic NetCDF files: SurfaceTopography's, read here, and GXSM's, whose unit of z Gwyddion does not take from where
/// it stands.

#include <optional>
#include <string>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// The variable "heights(x, y)" with its unit, size and mask; none if the file has no such variable.
/// @throw FileError without a file name: damaged, cut off.
std::optional<FileChannel> parseNetcdfHeights(const std::string& bytes);

/// Unit that a GXSM file states for its values, where that is no length: "nA", "Hz"; empty if it is one, or not stated.
/// @throw FileError without a file name: damaged.
std::string gxsmOtherUnit(const std::string& bytes);

}  // namespace mems_stiction
