#pragma once

/// @file
/// Lines of text as numbers.

#include <vector>

#include "import/text_style.hpp"

namespace mems_stiction {

/// Cells of all lines, one line after the other.
struct TextCells {
  std::vector<double>
      values;  ///< NaN for "nan", infinities, words for none and empty cells between delimiters
  std::size_t cols = 0;
  std::size_t rows = 0;
  bool is_last_shorter =
      false;  ///< the last number has fewer digits than every other: perhaps it was cut
};

/// @throw FileError without a file name, with line and column, for cells that are no numbers, empty
/// cells between tabs, and lines of another number of cells.
TextCells textCells(const std::vector<TextLine>& lines, const TextStyle& style);

}  // namespace mems_stiction
