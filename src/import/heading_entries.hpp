#pragma once

/// @file
/// The entries of a text's heading: "key: value" and "key = value", and what states a quantity a
/// second time.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Without blanks and quotes around it.
std::string bareText(const std::string& text);

/// A line of a heading without the signs of a comment. Blanks that do not break lines become plain
/// ones, and wide colons.
std::string headingContent(const std::string& line);

/// Parts the text at its first colon or equals sign, key in small letters. @return false if there
/// is none
bool splitEntry(const std::string& text, std::string& key, std::string& value);

/// The pieces of a line without quotes and the blanks around them.
std::vector<std::string> cellsOf(const std::string& line, char separator);

/// 0 = none is stated; more than any scan has stays more.
std::size_t headingCount(const std::string& value);

/// A number, with a decimal comma, too. @throw FileError for one that may be grouped by it
double headingNumber(const std::string& value);

/// @throw FileError for what the heading states a second time, and otherwise
template <typename Number>
void state(Number& field, Number value, const std::string& what) {
  constexpr double kSame = 1e-6;  // relative: what is stated twice may be rounded
  const auto before = static_cast<double>(field);
  const auto now = static_cast<double>(value);
  if (field != Number() && std::abs(before - now) > kSame * std::abs(now)) {
    throw FileError("the heading states the " + what + " twice, as " + numberText(before) +
                    " and " + numberText(now) + ": remove one");
  }
  field = value;
}

/// The same for names and units; two spellings of a unit of length are one.
void stateText(std::string& field, const std::string& value, const std::string& what);

}  // namespace mems_stiction
