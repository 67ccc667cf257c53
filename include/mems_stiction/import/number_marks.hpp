#pragma once

/// @file
/// Commas and points in numbers: which are decimal and which group thousands. "1,500" may be both.

#include <cstddef>
#include <string>

namespace mems_stiction {

/// What a mark can be.
enum class MarkUse { kAbsent, kDecimal, kEither, kGroups };

/// What `mark`, ',' or '.', can be in this number: decimal in "0,5" and "12,25", either in "1,500", groups in "1,500,000"
/// and in "1,500.2".
MarkUse markUse(const std::string& number, char mark);

/// The number as plainNumber() reads it: with a decimal point, without marks, blanks or apostrophes that group thousands.
/// - @p decimal ',' or '.'
/// @throw FileError without a file name, with the number, for a mark that neither is decimal nor groups three digits.
std::string withPlainMarks(const std::string& number, char decimal);

/// Writes a minus of typography as "-", and removes apostrophes, underscores and blanks that do not break lines between a
/// digit and three others: they group thousands and nothing else.
/// - @p text UTF-8
void plainSigns(std::string& text);

/// True if the blank at this place stands between groups of thousands, "1 500".
bool isGroupBlank(const std::string& text, std::size_t at);

/// What a mark that can be both is refused with. - @p number in which it stands
std::string ambiguousMark(const std::string& number);

}  // namespace mems_stiction
