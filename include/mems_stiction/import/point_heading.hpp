#pragma once

/// @file
/// The line above a list of points that names its columns: "x [nm] y [nm] z [pm]".

#include <optional>
#include <string>

namespace mems_stiction {

/// What such a line states.
struct PointHeading {
  double unit_xy = 0.0;  ///< of x and y [m]; 0 = none
  std::string unit_z;    ///< as it is spelt; empty = none
};

/// Units stand in brackets, or behind "/" or "_". None if the line does not name the columns x, y and z.
/// @throw FileError without a file name for columns in another order, and for units that some of them lack
std::optional<PointHeading> pointHeading(const std::string& text);

}  // namespace mems_stiction
