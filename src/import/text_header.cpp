#include "import/text_header.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <vector>

#include "import/heading_entries.hpp"
#include "import/heading_remarks.hpp"
#include "import/heading_words.hpp"
#include "import/length_unit.hpp"
#include "import/maker_headings.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

bool isOneOf(const std::string& key, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&key](const char* name) { return key == name; });
}

/// How the lengths of a heading are read.
struct Marks {
  char decimal = '\0';  ///< for marks that may be either; 0 = not known
  char of_data = '.';
};

/// Where the number at the beginning ends, whatever marks are in it.
std::size_t markedNumberEnd(const std::string& value) {
  const std::size_t end = std::min(value.find_first_not_of("+-0123456789.,"), value.size());
  const std::size_t exponent = numberEnd("1" + value.substr(end), 0) - 1;
  return end + exponent;
}

/// @throw FileError if the number's mark may be decimal or group thousands
char decimalMarkOf(const std::string& number, const Marks& marks) {
  const MarkUse comma = markUse(number, ',');
  const MarkUse point = markUse(number, '.');
  if (comma == MarkUse::kDecimal || point == MarkUse::kGroups) return ',';
  if (comma == MarkUse::kGroups || point == MarkUse::kDecimal) return '.';
  if (comma != MarkUse::kEither && point != MarkUse::kEither) return '.';
  if (marks.decimal != '\0') return marks.decimal;
  if ((comma == MarkUse::kEither) == (marks.of_data == ',')) return marks.of_data;
  throw FileError("'" + shownPiece(number) +
                  "' has a mark that may be decimal or group thousands: write the length " +
                  "without groups and with a decimal point, as 1.2 or 1200");
}

/// A length in metres; 0 for a number without unit, which may be a count of pixels.
double lengthOf(const std::string& value, const Marks& marks) {
  const std::size_t end = markedNumberEnd(value);
  const std::string number = value.substr(0, end);
  const auto stated =
      statedLength(withPlainMarks(number, decimalMarkOf(number, marks)) + value.substr(end));
  if (!stated) throw FileError("'" + shownPiece(value) + "' is not a length");
  if (stated->unit.empty()) return 0.0;
  const auto unit = lengthUnit(stated->unit);
  if (!unit) throw FileError("'" + shownPiece(stated->unit) + "' is not a unit of length");
  if (!(stated->number > 0.0) || !std::isfinite(stated->number)) {
    throw FileError("'" + shownPiece(value) + "' is not a length > 0");
  }
  return stated->number * *unit;
}

/// Blank or ESRI headings have "ncols 4"; the others "key: value" or "key = value".
bool splitKey(const std::string& text, std::string& key, std::string& value) {
  if (splitEntry(text, key, value)) return true;
  const std::size_t at = text.find_first_of(" \t");
  if (at == std::string::npos) return false;
  key = lowered(text.substr(0, at));
  value = bareText(text.substr(at));
  return isOneOf(key, {"ncols", "nrows", "cellsize", "nodata_value", "xllcorner", "yllcorner",
                       "xllcenter", "yllcenter"});
}

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
    const std::string axis = lowered(word.substr(0, 1));
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

/// What the line above a list of points states that names its columns: "x [nm] y [nm] z [pm]".
struct PointHeading {
  double unit_xy = 0.0;  ///< of x and y [m]; 0 = none
  std::string unit_z;    ///< as it is spelt; empty = none
};

/// Units stand in brackets, or behind "/" or "_". None if the line does not name the columns x, y
/// and z.
/// @throw FileError without a file name for columns in another order, and for units that some of
/// them lack
std::optional<PointHeading> pointHeading(const std::string& text) {
  std::string axes;
  const std::vector<PointColumn> columns = pointColumns(text);
  for (const PointColumn& column : columns) axes += column.axis;
  const auto is_axis = [&axes](char axis) { return axes.find(axis) < 3; };
  if (!is_axis('x') || !is_axis('y') || !is_axis('z')) return std::nullopt;
  if (!startsWith(axes, "xyz"))
    throw FileError("the columns of a list must be x, y and z, in this order");
  const std::string& unit_z = columns[2].unit;
  if (columns[0].unit.empty() && columns[1].unit.empty() && unit_z.empty()) return PointHeading();
  const auto unit = lengthUnit(columns[0].unit);
  if (!unit || lengthUnit(columns[1].unit) != unit || unit_z.empty()) {
    throw FileError(
        "x and y must have one unit of length, and z its own: write x [nm], y [nm], z [nm]");
  }
  return PointHeading{*unit, unit_z};
}

/// @return false if the text does not name the columns of a list. A comment does so if it states
/// their units
bool readPointHeading(const std::string& text, bool is_comment, TextHeader& header) {
  const auto stated = pointHeading(text);
  if (!stated || (is_comment && stated->unit_xy == 0.0)) return false;
  if (stated->unit_xy == 0.0) return true;
  state(header.unit_of_points, stated->unit_xy, "unit of x and y");
  stateText(header.unit_z, bareText(stated->unit_z), "unit of the heights");
  return true;
}

/// WSxM writes two lines before its texts, "WSxM file copyright UAM" and "WSxM ASCII XYZ file" or
/// "WSxM ASCII Matrix file".
bool readWsxmLine(const std::string& text, TextHeader& header) {
  if (startsWith(text, "WSxM file copyright") || startsWith(text, "WSxM ASCII Matrix")) return true;
  if (!startsWith(text, "WSxM ASCII XYZ")) return false;
  header.is_y_up = true;
  return true;
}

/// A side of the image or of a pixel. A number without a unit does not count, and is said.
void readLength(const std::string& value, const std::string& what, const Marks& marks,
                double& field, TextHeader& header) {
  const double length = lengthOf(value, marks);
  if (length > 0.0) {
    state(field, length, what);
  } else {
    header.notes.push_back("the " + what + " '" + shownPiece(value) +
                           "' has no unit and does not count");
  }
}

/// "h=650 w=650": rows and columns. @return false if the line is no such pair
bool readCounts(const std::string& text, TextHeader& header) {
  const std::vector<std::string> words = cellsOf(text, ' ');
  if (words.size() != 2 || words[0][0] == words[1][0]) return false;
  for (const std::string& word : words) {
    const bool is_count = word.size() > 2 && word.size() < 12 &&
                          (word[0] == 'h' || word[0] == 'w') && word[1] == '=' &&
                          word.find_first_not_of("0123456789", 2) == std::string::npos;
    if (!is_count) return false;
  }
  for (const std::string& word : words) {
    state(word[0] == 'h' ? header.rows : header.cols, headingCount(word.substr(2)),
          word[0] == 'h' ? "number of rows" : "number of columns");
  }
  return true;
}

/// The unit of "Z Amplitude: 25 nm", WSxM's: that of its numbers.
std::string unitOfAmplitude(const std::string& value) {
  return bareText(value.substr(markedNumberEnd(value)));
}

constexpr char kFactor[] = "height conversion factor (->";

/// "height conversion factor (-> m)=6.3e-8": what makes lengths of numbers in another unit, as
/// radians of a phase.
void readFactor(const std::string& key, const std::string& value, const Marks& marks,
                TextHeader& header) {
  const std::string unit = trimmed(key.substr(sizeof kFactor - 1), " \t)");
  if (!lengthUnit(unit)) throw FileError("'" + shownPiece(unit) + "' is not a unit of length");
  const std::size_t end = markedNumberEnd(value);
  double factor = 0.0;
  if (end > 0 && end == value.size())
    factor = plainNumber(withPlainMarks(value, decimalMarkOf(value, marks)));
  if (!(factor > 0.0) || !std::isfinite(factor)) {
    throw FileError("the height conversion factor '" + shownPiece(value) + "' is not a number > 0");
  }
  state(header.factor, factor, "height conversion factor");
  stateText(header.unit_of_factor, unit, "unit of the height conversion factor");
}

/// @return true if the key is known
bool readEntry(const std::string& key, const std::string& value, const Marks& marks,
               TextHeader& header) {
  const auto count = [&value] { return headingCount(value); };
  const HeadingWord word = headingWord(key);
  if (word == HeadingWord::kWidth) {
    readLength(value, "width", marks, header.width, header);
  } else if (word == HeadingWord::kHeight) {
    readLength(value, "height", marks, header.height, header);
  } else if (word == HeadingWord::kUnitZ && value.empty()) {
    header.unit_doubt =
        "'" + shownPiece(key) + "' of the heading is empty: its numbers have no unit";
  } else if (word == HeadingWord::kUnitZ) {
    stateText(header.unit_z, value, "unit of the heights");
  } else if (startsWith(key, kFactor)) {
    readFactor(key, value, marks, header);
  } else if (key == "z amplitude") {
    stateText(header.unit_z, unitOfAmplitude(value), "unit of the heights");
  } else if (word == HeadingWord::kUnitXy) {  // Gwyddion's lists: x and y are those of its images
    const auto unit = lengthUnit(value);
    if (!unit) throw FileError("'" + shownPiece(value) + "' is not a unit of length");
    state(header.unit_of_points, *unit, "unit of x and y");
    header.is_y_up = false;
  } else if (word == HeadingWord::kTitle) {
    stateText(header.title, value, "channel");
  } else if (isOneOf(key, {"x-pixels", "ncols", "nx", "columns"})) {
    state(header.cols, count(), "number of columns");
  } else if (isOneOf(key, {"y-pixels", "nrows", "ny", "rows"})) {
    state(header.rows, count(), "number of rows");
  } else if (key == "pixel size" || key == "pitch") {
    readLength(value, "pitch", marks, header.pitch_x, header);
    if (header.pitch_x > 0.0) state(header.pitch_y, header.pitch_x, "pitch");
  } else if (isOneOf(key, {"pitch_x", "scale x"})) {
    readLength(value, "pitch of columns", marks, header.pitch_x, header);
  } else if (isOneOf(key, {"pitch_y", "scale y"})) {
    readLength(value, "pitch of rows", marks, header.pitch_y, header);
  } else if (key == "cellsize") {
    header.notes.push_back("the cell size " + shownPiece(value) +
                           " has no unit and does not count");
  } else if (key == "nodata_value") {
    const double missing = plainNumber(value);
    if (header.missing_value) state(*header.missing_value, missing, "missing value");
    header.missing_value = missing;
  } else {
    return isOneOf(key, {"xllcorner", "yllcorner", "xllcenter", "yllcenter"});
  }
  return true;
}

/// "Height(nm)", "Height_Sensor [nm]": name and unit of a matrix. @return false for other texts
bool readNameAndUnit(const std::string& text, TextHeader& header) {
  if (text.empty()) return false;
  const std::size_t open = text.find_first_of("([");
  const bool is_named = open != std::string::npos && open > 0 &&
                        (text.back() == ')' || text.back() == ']') &&
                        text.find_first_of("([", open + 1) == std::string::npos &&
                        text.find_first_of("\t,;:=") == std::string::npos;
  if (!is_named) return false;
  const std::string unit = text.substr(open + 1, text.size() - open - 2);
  if (!lengthUnit(unit) && !isOtherUnit(unit)) return false;
  stateText(header.title, bareText(replaced(text.substr(0, open), "_", " ")), "channel");
  stateText(header.unit_z, unit, "unit of the heights");
  return true;
}

}  // namespace

char headingMark(const std::vector<TextLine>& heading) {
  bool has_comma = false;
  bool has_point = false;
  for (const TextLine& line : heading) {
    std::string key;
    std::string value;
    if (!splitKey(headingContent(line.text), key, value)) continue;
    const std::size_t end = markedNumberEnd(value);
    if (end == 0 || !lengthUnit(value.substr(end))) continue;
    const std::string number = value.substr(0, end);
    const bool is_comma =
        markUse(number, ',') == MarkUse::kDecimal || markUse(number, '.') == MarkUse::kGroups;
    const bool is_point =
        markUse(number, '.') == MarkUse::kDecimal || markUse(number, ',') == MarkUse::kGroups;
    has_comma = has_comma || is_comma;
    has_point = has_point || is_point;
  }
  if (has_comma == has_point) return '\0';
  return has_comma ? ',' : '.';
}

TextHeader textHeader(const std::vector<TextLine>& heading, char decimal, char of_data) {
  if (auto header = makerHeading(heading)) return *header;
  const Marks marks{decimal, of_data};
  TextHeader header;
  HeadingRemarks remarks;
  for (const TextLine& line : heading) {
    const std::string text = headingContent(line.text);
    const bool is_comment = !line.text.empty() && (line.text[0] == '#' || line.text[0] == '%');
    const std::string where = lineName(line);
    std::string key;
    std::string value;
    try {
      if (readCounts(text, header)) continue;
      if (splitKey(text, key, value) && readEntry(key, value, marks, header)) continue;
      if (readWsxmLine(text, header)) continue;
      if (readPointHeading(text, is_comment, header)) continue;
      if (readNameAndUnit(text, header)) continue;
    } catch (const FileError& error) {
      throw FileError(where + error.what());
    }
    if (!is_comment) {
      const std::string word = text.substr(0, text.find_first_of(" \t,;"));
      throw FileError(
          where + "'" + shownPiece(word) +
          "' is not a number, column 1, and begins no known heading: keep the numbers, " +
          "and state \"# Width: 2 um\", \"# Height: 2 um\" and \"# Value units: nm\"");
    }
    remarks.read(where, text, value);
  }
  if (header.factor > 0.0) {  // the unit of the numbers is that before it
    header.scale = header.factor;
    header.unit_z = header.unit_of_factor;
  }
  if (!header.unit_z.empty()) {
    header.unit_doubt.clear();
    return header;
  }
  if (header.unit_doubt.empty()) header.unit_doubt = remarks.doubt;
  TextHeader of_title;
  if (header.unit_doubt.empty() && readNameAndUnit(header.title, of_title)) {
    header.unit_doubt = "the channel is named '" + shownPiece(header.title) +
                        "' and the heading states no unit of its numbers: state \"# Value units: " +
                        of_title.unit_z + "\"";
  }
  if (!remarks.side.empty()) header.notes.push_back(remarks.side);
  return header;
}

}  // namespace mems_stiction
