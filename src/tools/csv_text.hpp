#pragma once

/// Texts in the cells of CSV files.

#include <cstring>
#include <string>
#include <vector>

namespace mems_stiction {

/// The cell, quoted where it must be. @param separator of cells
inline std::string csvQuoted(const std::string& cell, char separator = ',') {
  if (cell.find_first_of({'"', separator}) == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char letter : cell)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

/// A line with a cell for each column. @param cell_of the text of a column's cell, as it stands
template <typename CellOf>
std::string csvLine(const std::vector<std::string>& columns, char separator,
                    const CellOf& cell_of) {
  std::string line;
  for (const std::string& column : columns) {
    if (&column != &columns.front()) line += separator;
    line += cell_of(column);
  }
  return line + "\n";
}

/// The text as a cell: quoted where it must be, and with an apostrophe before what a spreadsheet
/// would take for the beginning of a formula.
inline std::string csvText(std::string text) {
  if (!text.empty() && std::strchr("=+-@\t", text.front()) != nullptr) text.insert(0, "'");
  return csvQuoted(text);
}

}  // namespace mems_stiction
