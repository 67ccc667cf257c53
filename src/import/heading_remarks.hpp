#pragma once

/// @file
/// What the lines of a heading that are not understood say of units.

#include <string>

namespace mems_stiction {

/// True for a unit of another quantity than length, with or without a prefix: "A", "mV", "deg".
bool isOtherUnit(const std::string& text);

/// The first remarks of a heading.
struct HeadingRemarks {
  std::string side;  ///< a length, which was meant to be read: a warning
  std::string
      doubt;  ///< a unit without a number, perhaps that of the heights, which then cannot be told

  /// - @p where the line, in words
  /// - @p value what stands behind the key of the line, if there is one
  void read(const std::string& where, const std::string& text, const std::string& value);
};

}  // namespace mems_stiction
