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

/// What a GXSM file states where Gwyddion does not look.
struct GxsmStatements {
  std::string other_unit;  ///< of the values where that is no length: "nA", "Hz"; empty if it is one, or not stated
  double pitch_x = 0.0;    ///< [m]; GXSM's range reaches from the first pixel to the last; 0 = not stated
  double pitch_y = 0.0;    ///< [m]
};

/// @throw FileError without a file name: damaged, a pitch that is not the range over the steps
GxsmStatements gxsmStatements(const std::string& bytes);

}  // namespace mems_stiction
