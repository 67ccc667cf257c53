#pragma once

/// @file
/// Numbers in text, whatever locale the process runs in: with a decimal point, or with commas and
/// points of which some are decimal and some group thousands. "1,500" may be both.

#include <cstddef>
#include <string>

namespace mems_stiction {

/// Where the number that begins at `at` ends: digits, point and exponent ("e" or Fortran's "D"), or
/// "nan" and "inf" in any case. The same position if there is none.
std::size_t numberEnd(const std::string& text, std::size_t at);

/// Value of a text that is a number as a whole. @throw FileError without a file name, with the
/// text, if it is none or too large for a double.
double plainNumber(const std::string& text);

/// A word that stands for a number that was not measured: "N/A", "BAD", "---" and others, in any
/// case.
bool isMissingWord(const std::string& text);

/// A short piece of a text for a message: control characters as "?".
std::string shownPiece(const std::string& text, std::size_t at = 0);

/// What a mark can be.
enum class MarkUse { kAbsent, kDecimal, kEither, kGroups };

/// What `mark`, ',' or '.', can be in this number: decimal in "0,5" and "12,25", either in "1,500",
/// groups in "1,500,000" and in "1,500.2".
MarkUse markUse(const std::string& number, char mark);

/// The number as plainNumber() reads it: with a decimal point, without marks, blanks or apostrophes
/// that group thousands.
/// - @p decimal ',' or '.'
/// @throw FileError without a file name, with the number, for a mark that neither is decimal nor
/// groups three digits.
std::string withPlainMarks(const std::string& number, char decimal);

/// Writes a minus of typography as "-", and removes apostrophes, underscores and blanks that do not
/// break lines between a digit and three others: they group thousands and nothing else.
/// - @p text UTF-8
void plainSigns(std::string& text);

/// Writes what programs of Windows print for no number, "-nan(ind)", "nan(snan)", "1.#QNAN",
/// "-1,#IND00", as "nan".
void plainNans(std::string& text);

/// True if the blank at this place stands between groups of thousands, "1 500".
bool isGroupBlank(const std::string& text, std::size_t at);

/// What a mark that can be both is refused with. - @p number in which it stands
std::string ambiguousMark(const std::string& number);

}  // namespace mems_stiction
