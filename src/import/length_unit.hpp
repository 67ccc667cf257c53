#pragma once

/// @file
/// Units of length as files spell them.

#include <optional>
#include <string>

namespace mems_stiction {

/// Metres in one of this unit: 1e-9 for "nm", 1e-6 for "µm", "um" or "microns" (UTF-8, either sign
/// for micro). Blanks and brackets around it do not count. None for anything that is no length.
std::optional<double> lengthUnit(const std::string& text);

/// The same for the unit of heights. "A" is none: there it is the ampere of a current as well as an
/// angstrom.
std::optional<double> heightUnit(const std::string& text);

/// A number and its unit of length, "1.5 µm" or "1.5e-6", in metres.
struct StatedLength {
  double number = 0.0;
  std::string unit;  ///< as it is spelt; empty if there is none
};

/// None if the text does not begin with a number.
std::optional<StatedLength> statedLength(const std::string& text);

/// Bytes of the code pages of Western Europe as UTF-8; text that is UTF-8 already stays. 0xE6
/// before "m" is the micro of MS-DOS.
std::string toUtf8(const std::string& text);

}  // namespace mems_stiction
