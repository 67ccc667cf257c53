#pragma once

/// @file
/// Which character separates the numbers of a text, and which is the decimal one.

#include <functional>
#include <string>
#include <vector>

#include "import/text_lines.hpp"

namespace mems_stiction {

/// How numbers stand in a text. One style applies to the whole file.
struct TextStyle {
  char separator = ' ';  ///< ',' or ';'; ' ' is blanks and tabs
  char decimal = '.';    ///< or ','; the other one groups thousands
  bool has_end = false;  ///< every line ends with a separator, which begins no cell
  std::string guess;  ///< a number whose point may group thousands, as that of every other number;
                      ///< empty = sure
};

/// A piece of a line between separators.
struct TextPiece {
  std::size_t begin = 0, end = 0;
};

/// Pieces between separators outside quotes, without the blanks around them. For blanks as
/// separator none is empty.
std::vector<TextPiece> piecesOf(const std::string& text, char separator);

/// The same one by one, as a line may have millions: calls `take(piece)` until it returns false.
void forEachPiece(const std::string& text, char separator,
                  const std::function<bool(const TextPiece&)>& take);

/// The piece without the quotes around it.
std::string unquoted(const std::string& text, const TextPiece& piece);

/// Joins the groups of thousands that blanks part, where tabs or semicolons separate the numbers.
/// @throw FileError without a file name, with a line, where the blanks may part numbers as well.
void joinThousands(std::vector<TextLine>& lines);

/// The style that fits every line. A comma between two digits is decimal if other characters
/// separate the cells.
/// - @p stated the decimal sign, '.' or ','; 0 = not stated
/// - @p hint the decimal sign of other numbers in the file, for marks that may be either; 0 = none
/// @throw FileError without a file name, with a line, where two readings are possible; without a
/// line for more cells than a scan may have.
TextStyle textStyle(const std::vector<TextLine>& lines, char stated = '\0', char hint = '\0');

}  // namespace mems_stiction
