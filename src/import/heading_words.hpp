#pragma once

/// @file
/// The words by which headings name what they state, in the languages that Gwyddion speaks.

#include <string>

namespace mems_stiction {

/// What an entry of a heading states.
enum class HeadingWord { kNone, kTitle, kWidth, kHeight, kUnitZ, kUnitXy };

/// - @p key ASCII in small letters, other letters as they are, without the colon
HeadingWord headingWord(const std::string& key);

}  // namespace mems_stiction
