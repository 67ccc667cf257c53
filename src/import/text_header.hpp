#pragma once

/// @file
/// What the heading of a text file says of its numbers: as Gwyddion, SurfaceTopography, SPIP,
/// Attocube, Nova, WSxM, Wyko, Keyence and ESRI grids write it.

#include <optional>
#include <string>
#include <vector>

#include "import/text_lines.hpp"

namespace mems_stiction {

/// What the heading of a text file states.
struct TextHeader {
  std::string title;                    ///< "Channel: Height"
  double width = 0.0, height = 0.0;     ///< "Width: 1 µm" [m]; 0 = not stated
  double pitch_x = 0.0, pitch_y = 0.0;  ///< "cellsize", "Scale X" [m]; 0 = not stated
  double scale = 1.0;                   ///< of the numbers, in unit_z
  double factor =
      0.0;  ///< "height conversion factor (-> m)", before scale and unit_z; 0 = not stated
  std::string unit_of_factor;  ///< what the factor makes of the numbers, as it is spelt
  std::string unit_z;          ///< "Value units: nm", as it is spelt; empty = not stated
  double unit_of_points =
      0.0;  ///< of x and y in a heading "x [nm] y [nm] z [nm]" [m]; 0 = not stated
  std::size_t cols = 0, rows = 0;       ///< 0 = not stated
  std::optional<double> missing_value;  ///< "NODATA_value"
  bool has_void_map = false;    ///< SPIP: as many lines more, 0 where a pixel was not measured
  std::optional<bool> is_y_up;  ///< in lists of points: WSxM's is, Gwyddion's is not
  std::string unit_doubt;       ///< what is said of the unit of the heights and is not understood
  std::vector<std::string> notes;  ///< what else stands there and is not understood
};

/// The decimal sign of the lengths in a heading, '.' or ','; 0 where they leave it open.
char headingMark(const std::vector<TextLine>& heading);

/// - @p decimal the sign that marks of lengths are read by which may be decimal or group thousands;
/// 0 = not known
/// - @p of_data the decimal sign of the data
/// @throw FileError without a file name, with the line, for a line outside a comment that is no
/// known heading, for a length whose unit is no length or whose mark may be either, and for what is
/// stated twice and differs.
TextHeader textHeader(const std::vector<TextLine>& heading, char decimal, char of_data);

}  // namespace mems_stiction
