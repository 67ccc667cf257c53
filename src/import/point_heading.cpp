#include "mems_stiction/import/point_heading.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/length_unit.hpp"

namespace mems_stiction {
namespace {

/// "x [nm]", "X/um", "x_nm"
struct PointColumn {
  char axis = ' ';   ///< x, y, z; ' ' for any other
  std::string unit;  ///< as it is spelt; empty if there is none
};

/// Words between separators; what stands in brackets belongs to the word before.
std::vector<PointColumn> pointColumns(const std::string& text) {
  std::vector<std::string> words;
  bool is_in_word = false;
  bool is_in_brackets = false;
  for (const char c : text) {
    if (!is_in_brackets && std::string(" \t,;|\"'").find(c) != std::string::npos) {
      is_in_word = false;
      continue;
    }
    if (c == '[' || c == '(') is_in_brackets = true;
    if (!is_in_word && (words.empty() || !is_in_brackets)) words.emplace_back();
    is_in_word = true;
    words.back() += c;
    if (c == ']' || c == ')') is_in_brackets = false;
  }
  std::vector<PointColumn> columns;
  for (const std::string& word : words) {
    PointColumn column;
    const bool is_name = word.size() == 1 || std::isalnum(static_cast<unsigned char>(word[1])) == 0;
    const std::string axis = std::string(1, static_cast<char>(std::tolower(static_cast<unsigned char>(word[0]))));
    if (is_name && std::string("xyz").find(axis) != std::string::npos) column.axis = axis[0];
    const std::size_t open = word.find_first_of("[(");
    if (open != std::string::npos) {
      column.unit = word.substr(open + 1, word.find_first_of("])", open) - open - 1);
    } else if (word.size() > 2 && lengthUnit(word.substr(2))) {
      column.unit = word.substr(2);
    }
    columns.push_back(column);
  }
  return columns;
}

}  // namespace

std::optional<PointHeading> pointHeading(const std::string& text) {
  std::string axes;
  const std::vector<PointColumn> columns = pointColumns(text);
  for (const PointColumn& column : columns) axes += column.axis;
  const auto is_axis = [&axes](char axis) { return axes.find(axis) < 3; };
  if (!is_axis('x') || !is_axis('y') || !is_axis('z')) return std::nullopt;
  if (axes.compare(0, 3, "xyz") != 0) throw FileError("the columns of a list must be x, y and z, in this order");
  const std::string& unit_z = columns[2].unit;
  if (columns[0].unit.empty() && columns[1].unit.empty() && unit_z.empty()) return PointHeading();
  const auto unit = lengthUnit(columns[0].unit);
  if (!unit || lengthUnit(columns[1].unit) != unit || unit_z.empty()) {
    throw FileError("x and y must have one unit of length, and z its own: write x [nm], y [nm], z [nm]");
  }
  return PointHeading{*unit, unit_z};
}

}  // namespace mems_stiction
