#pragma once

/// @file
/// Lines of text as numbers: which character separates them, and which is the decimal one.

#include <vector>

#include "mems_stiction/import/text_lines.hpp"

namespace mems_stiction {

/// How numbers stand in a text. One style holds for the whole file.
struct TextStyle {
  char separator = ' ';  ///< ',' or ';'; ' ' is blanks and tabs
  char decimal = '.';    ///< or ','
  bool has_end = false;  ///< every line ends with a separator, which begins no cell
};

/// Cells of all lines, one line after the other.
struct TextCells {
  std::vector<double> values;  ///< NaN for "nan", infinities and empty cells between delimiters
  std::size_t cols = 0;
  std::size_t rows = 0;
  bool is_last_shorter = false;  ///< the last number has fewer digits than every other: perhaps it was cut
};

/// The style that fits every line. A comma between two digits is decimal if other characters separate the cells.
/// @throw FileError without a file name, with a line, where two readings are possible.
TextStyle textStyle(const std::vector<TextLine>& lines);

/// @throw FileError without a file name, with line and column, for cells that are no numbers, empty cells between tabs,
/// and lines of another number of cells.
TextCells textCells(const std::vector<TextLine>& lines, const TextStyle& style);

}  // namespace mems_stiction
