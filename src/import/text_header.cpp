#include "mems_stiction/import/text_header.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/length_unit.hpp"
#include "mems_stiction/import/plain_number.hpp"

namespace mems_stiction {
namespace {

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string trimmed(const std::string& text) {
  const char* around = " \t\"'";
  const std::size_t begin = text.find_first_not_of(around);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(around) - begin + 1);
}

/// Without the signs of a comment; blanks that do not break lines become plain ones.
std::string content(const std::string& line) {
  std::string text = line.substr(std::min(line.find_first_not_of("#% \t"), line.size()));
  for (const char* blank : {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89"}) {
    for (std::size_t at = text.find(blank); at != std::string::npos; at = text.find(blank)) {
      text.replace(at, std::char_traits<char>::length(blank), " ");
    }
  }
  return trimmed(text);
}

bool isOneOf(const std::string& key, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&key](const char* name) { return key == name; });
}

/// "1,50 µm" from a country of decimal commas.
std::string withPoint(std::string text) {
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos && text.find('.') == std::string::npos) text[comma] = '.';
  return text;
}

/// A length in metres; 0 for a number without unit, which may be a count of pixels.
double lengthOf(const std::string& value) {
  const auto stated = statedLength(withPoint(value));
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
  std::size_t at = text.find_first_of(":=");
  if (at == std::string::npos) {
    at = text.find_first_of(" \t");
    if (at == std::string::npos) return false;
    key = lowered(text.substr(0, at));
    value = trimmed(text.substr(at));
    return isOneOf(key,
                   {"ncols", "nrows", "cellsize", "nodata_value", "xllcorner", "yllcorner", "xllcenter", "yllcenter"});
  }
  key = lowered(trimmed(text.substr(0, at)));
  value = trimmed(text.substr(at + 1));
  return true;
}

/// Units in brackets, in their order: "x [nm], y [nm], z [nm]". @return false if the text is no such heading
bool readPointHeading(const std::string& text, TextHeader& header) {
  const std::string low = lowered(text);
  const std::size_t y = low.find('y');
  const std::size_t z = low.find('z');
  if (low.empty() || low[0] != 'x' || y == std::string::npos || z == std::string::npos || z < y) return false;
  std::vector<std::string> units;
  for (std::size_t open = text.find_first_of("[("); open != std::string::npos;
       open = text.find_first_of("[(", open + 1)) {
    const std::size_t close = text.find_first_of("])", open);
    if (close == std::string::npos) return false;
    units.push_back(trimmed(text.substr(open + 1, close - open - 1)));
  }
  if (units.empty()) return true;
  const auto unit_x = lengthUnit(units[0]);
  if (units.size() != 3 || !unit_x || lengthUnit(units[1]) != unit_x) {
    throw FileError("x and y must have one unit of length");
  }
  header.unit_of_points = *unit_x;
  header.unit_z = units[2];
  return true;
}

/// @return true if the key is known
bool readEntry(const std::string& key, const std::string& value, TextHeader& header) {
  const auto count = [&value] { return static_cast<std::size_t>(std::max(0.0, plainNumber(value))); };
  if (isOneOf(key, {"width", "x-length", "breite", "largeur", "anchura", "larghezza", "largura"})) {
    header.width = lengthOf(value);
    if (header.width == 0.0)
      header.notes.push_back("the width '" + shownPiece(value) + "' has no unit and does not count");
  } else if (isOneOf(key, {"height", "y-length", "höhe", "hauteur", "altura", "altezza"})) {
    header.height = lengthOf(value);
    if (header.height == 0.0)
      header.notes.push_back("the height '" + shownPiece(value) + "' has no unit and does not count");
  } else if (isOneOf(key, {"value units", "value unit", "z-unit", "zunit", "unit data", "einheiten", "unités"})) {
    header.unit_z = value;
  } else if (isOneOf(key, {"channel", "kanal", "canal", "canale"})) {
    header.title = value;
  } else if (isOneOf(key, {"x-pixels", "ncols", "nx", "columns"})) {
    header.cols = count();
  } else if (isOneOf(key, {"y-pixels", "nrows", "ny", "rows"})) {
    header.rows = count();
  } else if (key == "pixel size" || key == "pitch") {
    header.pitch_x = header.pitch_y = lengthOf(value);
  } else if (isOneOf(key, {"pitch_x", "scale x"})) {
    header.pitch_x = lengthOf(value);
  } else if (isOneOf(key, {"pitch_y", "scale y"})) {
    header.pitch_y = lengthOf(value);
  } else if (key == "cellsize") {
    header.notes.push_back("the cell size " + shownPiece(value) + " has no unit and does not count");
  } else if (key == "nodata_value") {
    header.missing_value = plainNumber(value);
  } else {
    return isOneOf(key, {"xllcorner", "yllcorner", "xllcenter", "yllcenter"});
  }
  return true;
}

/// A unit of length that a remark mentions: somebody meant it to be read.
std::string unitMentioned(const std::string& text) {
  std::string word;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    if (at < text.size() && std::string(" \t,;:=()[]/").find(text[at]) == std::string::npos) {
      word += text[at];
      continue;
    }
    if (word.size() > 1 && word != "inch" && lengthUnit(word)) return word;
    word.clear();
  }
  return "";
}

}  // namespace

TextHeader textHeader(const std::vector<TextLine>& heading) {
  TextHeader header;
  std::string mentioned;
  for (const TextLine& line : heading) {
    const std::string text = content(line.text);
    const bool is_comment = !line.text.empty() && (line.text[0] == '#' || line.text[0] == '%');
    const std::string where = "line " + std::to_string(line.number) + ": ";
    std::string key;
    std::string value;
    try {
      if (splitKey(text, key, value) && readEntry(key, value, header)) continue;
      if (!is_comment && readPointHeading(text, header)) continue;
      if (is_comment && text.size() < 80 && readPointHeading(text, header) && header.unit_of_points > 0.0) continue;
    } catch (const FileError& error) {
      throw FileError(where + error.what());
    }
    if (!is_comment) {
      const std::string word = text.substr(0, text.find_first_of(" \t,;"));
      throw FileError(where + "'" + shownPiece(word) + "' is not a number, column 1");
    }
    const std::string unit = unitMentioned(text);
    if (mentioned.empty() && !unit.empty()) {
      mentioned =
          where + "'" + shownPiece(unit) + "' is not understood there; \"# Value units: " + unit + "\" would be";
    }
  }
  if (header.unit_z.empty() && !mentioned.empty()) header.notes.push_back(mentioned);
  return header;
}

}  // namespace mems_stiction
