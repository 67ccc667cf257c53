#pragma once

/// @file
/// A text file as lines of data and lines of heading, whatever its encoding and line ends.

#include <string>
#include <vector>

namespace mems_stiction {

/// One line.
struct TextLine {
  int number = 0;    ///< in the file, from 1
  std::string text;  ///< UTF-8, without comment and without blanks at both ends
};

/// Before what is wrong with it: "line 3: ".
std::string lineName(const TextLine& line);

/// The lines of a file, heading and data apart.
struct TextLines {
  std::vector<TextLine> heading;  ///< comments, and lines before the data that begin with a letter
  std::vector<TextLine> data;     ///< lines that begin with a number, a delimiter or a quote
  std::vector<std::size_t>
      blocks;  ///< where in `data` a block begins: after an empty line or a comment
  bool ends_with_line_end = true;
};

/// UTF-8 with or without byte order mark, UTF-16, or bytes of a Western code page. '#' and '%'
/// begin a comment, at the start of a line or after a blank.
/// @throw FileError without a file name, with the line, for binary data.
TextLines textLines(const std::string& bytes);

}  // namespace mems_stiction
