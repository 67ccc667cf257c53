#pragma once

/// @file
/// A text of several lines on one, for logs, records and people who count lines.

#include <string>

namespace mems_stiction {

/// Line ends become "; ", other control characters "\\x1b" and the like, those of two bytes in UTF-8 (U+0080 to U+009F, which
/// terminals obey too) "\\xc2\\x9b": no text can move the cursor, hide what was said
/// before, or begin a line of its own. So do bytes that are no UTF-8, as in names of files: what is said is always UTF-8.
std::string oneLine(const std::string& text);

}  // namespace mems_stiction
