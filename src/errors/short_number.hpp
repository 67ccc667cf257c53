#pragma once

/// @file
/// Numbers as people read them: rounded to what is known. Whoever computes on takes numberText() of
/// option_visitor.hpp.

#include <string>

namespace mems_stiction {

/// Significant digits, without an exponent up to a million: "0.0299", "7250", "1.2e-07"; "nan"
/// without a sign.
std::string shortNumber(double value, int digits = 3);

/// How many digits of a value are worth showing whose 95 % interval is this: two where it reaches
/// further than 5 % to either side, else three; three where it is not known.
int knownDigits(double value, double lower, double upper);

/// "2.1e-07 N, 95 % within 1.5e-07 to 2.9e-07 N", rounded so; without the interval where it is not
/// known.
std::string withInterval(double value, double lower, double upper, const std::string& unit = "");

}  // namespace mems_stiction
