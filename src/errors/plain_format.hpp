#pragma once

/// @file
/// Numbers as text and back with a decimal point, whatever locale the process runs in: Python
/// programs and Qt set that of the user, where printf() and strtod() take a decimal comma. The
/// compilers that are supported do not all have std::from_chars() and std::to_chars() for doubles.

#include <locale>
#include <sstream>
#include <string>

namespace mems_stiction {

/// What printf() writes in the locale "C".
[[gnu::format(printf, 1, 2)]] std::string plainFormat(const char* format, ...);

/// As strtod() reads in the locale "C".
/// - @p end where to put the end of the number; may be null
double plainStrtod(const char* text, char** end = nullptr);

/// Whether a number that is not 0 was read as 0, as 1e-400 is.
/// - @p text that the value was read from
bool isLostInReading(const std::string& text, double value);

/// A text stream of the locale "C".
struct PlainStream : std::ostringstream {
  PlainStream() { imbue(std::locale::classic()); }
};

}  // namespace mems_stiction
