#pragma once

/// @file
/// Dates as the makers of instruments write them.

#include <string>

namespace mems_stiction {

/// The date by ISO 8601, with the time of day and the zone as far as the text states them:
/// "2014-12-15T13:33:51" of "01:33:51 PM Mon Dec 15 2014". Empty for no text, and for the zero that
/// programs write for want of a date. A text that can be read in two ways, "03/11/2011", stays as
/// it is; one without a date is none.
std::string acquisitionTime(const std::string& text);

}  // namespace mems_stiction
