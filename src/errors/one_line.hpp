#pragma once

/// @file
/// A text of several lines on one, for logs, records and people who count lines.

#include <cstddef>
#include <string>

namespace mems_stiction {

/// Line ends become "; ", other control characters "\\x1b" and the like, those of two bytes in
/// UTF-8 (U+0080 to U+009F, which terminals obey too) "\\xc2\\x9b": no text can move the cursor,
/// hide what was said before, or begin a line of its own. So do bytes that are no UTF-8, as in
/// names of files: what is said is always UTF-8.
std::string oneLine(const std::string& text);

/// The text, or its beginning and its size where it has more than `most` bytes: "aaaa... (5000000
/// bytes)". No letter of UTF-8 is cut.
std::string shortened(const std::string& text, std::size_t most);

/// Of a value that a sentence quotes, and of a whole sentence [bytes].
inline constexpr std::size_t kLongestQuotation = 100;
inline constexpr std::size_t kLongestSentence = 2000;

}  // namespace mems_stiction
