#include "import/maker_headings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "import/heading_entries.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr char kWyko[] = "Wyko ASCII Data File Format";
constexpr double kNanometre = 1e-9;

double lengthUnitOf(const std::string& text) {
  const auto unit = lengthUnit(text);
  if (!unit) throw FileError("'" + shownPiece(text) + "' is not a unit of length");
  return *unit;
}

/// Wyko's text: blocks "name, type, length, value" between tabs, pitch in mm, heights in nm or in
/// waves over `Mult`. Its "X Size" is the number of lines.
TextHeader wykoHeading(const std::vector<TextLine>& heading) {
  TextHeader header;
  header.unit_z = "nm";
  double wavelength = 0.0;
  double divisor = 1.0;
  for (const TextLine& line : heading) {
    const std::vector<std::string> cells = cellsOf(line.text, '\t');
    const std::string key = lowered(cells[0]);
    if (cells.size() == 2 && key == "x size")
      state(header.rows, headingCount(cells[1]), "number of rows");
    if (cells.size() == 2 && key == "y size")
      state(header.cols, headingCount(cells[1]), "number of columns");
    if (cells.size() < 4 || cells[3].empty()) continue;
    if (key == "pixel_size") header.pitch_x = header.pitch_y = 1e-3 * plainNumber(cells[3]);
    if (key == "wavelength") wavelength = plainNumber(cells[3]);
    if (key == "mult") divisor = plainNumber(cells[3]);
  }
  const std::vector<std::string> flags =
      cellsOf(heading.front().text.substr(sizeof kWyko - 1), '\t');
  if (flags.size() > 1 && flags[1] == "1") return header;
  if (!(wavelength > 0.0) || !(divisor > 0.0)) {
    throw FileError("Wyko's heights are in waves and the heading states no wavelength");
  }
  header.scale = wavelength / divisor;
  return header;
}

/// Spreadsheets write semicolons where a comma is decimal, and leave quotes out.
char keyenceSeparator(const std::string& line) {
  return line.find(';') != std::string::npos ? ';' : ',';
}

bool isKeyence(const std::vector<TextLine>& heading) {
  return std::any_of(heading.begin(), heading.end(), [](const TextLine& line) {
    return lowered(cellsOf(line.text, keyenceSeparator(line.text))[0]) == "xy calibration";
  });
}

/// Keyence's tables: "key","value","unit", of which pitch, numbers of pixels and unit of the
/// heights count.
TextHeader keyenceHeading(const std::vector<TextLine>& heading) {
  TextHeader header;
  for (const TextLine& line : heading) {
    const std::vector<std::string> cells = cellsOf(line.text, keyenceSeparator(line.text));
    const std::string key = lowered(cells[0]);
    if (cells.size() >= 3 && key == "xy calibration") {
      header.pitch_x = header.pitch_y = headingNumber(cells[1]) * lengthUnitOf(cells[2]);
    }
    if (cells.size() < 2) continue;
    if (key == "horizontal") state(header.cols, headingCount(cells[1]), "number of columns");
    if (key == "vertical") state(header.rows, headingCount(cells[1]), "number of rows");
    if (key == "unit") stateText(header.unit_z, cells[1], "unit of the heights");
    if (key == "output image data") header.title = cells[1];
  }
  if (header.unit_z.empty())
    header.unit_doubt = "Keyence's heading states no unit of the heights (\"Unit\",\"mm\")";
  return header;
}

using Entries = std::map<std::string, std::string>;

/// Every entry of the heading; one that stands there twice must say the same.
Entries entriesOf(const std::vector<TextLine>& heading) {
  Entries entries;
  for (const TextLine& line : heading) {
    std::string key;
    std::string value;
    if (!splitEntry(headingContent(line.text), key, value)) continue;
    const auto [entry, is_new] = entries.emplace(key, value);
    if (!is_new && !value.empty()) stateText(entry->second, value, key);
  }
  return entries;
}

std::string entryText(const Entries& entries, const std::string& key) {
  const auto found = entries.find(key);
  return found == entries.end() ? "" : found->second;
}

std::size_t countEntry(const Entries& entries, const std::string& key) {
  const std::string value = entryText(entries, key);
  return value.empty() ? 0 : headingCount(value);
}

/// [m]; 0 = not stated. @throw FileError for a length that is no number > 0
double lengthEntry(const Entries& entries, const std::string& key, double unit) {
  const std::string value = entryText(entries, key);
  if (value.empty()) return 0.0;
  const double length = std::abs(headingNumber(value)) * unit;
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw FileError("the heading states '" + key + "' as '" + shownPiece(value) +
                    "', which is no length > 0");
  }
  return length;
}

/// SPIP: sides in nm whatever the unit of the heights; these in "z-unit", else "Bit2nm" nm for each
/// count. Where "voidpixels" counts some, a second matrix behind the heights is 0 at each.
TextHeader spipHeading(const Entries& entries) {
  TextHeader header;
  header.cols = countEntry(entries, "x-pixels");
  header.rows = countEntry(entries, "y-pixels");
  header.width = lengthEntry(entries, "x-length", kNanometre);
  header.height = lengthEntry(entries, "y-length", kNanometre);
  header.has_void_map = countEntry(entries, "voidpixels") > 0;
  header.unit_z = entryText(entries, "z-unit");
  if (!header.unit_z.empty()) return header;
  if (entryText(entries, "bit2nm").empty()) {
    header.unit_doubt = "SPIP's heading states no unit of the heights (\"# z-unit = nm\")";
    return header;
  }
  header.unit_z = "nm";
  header.scale = lengthEntry(entries, "bit2nm", 1.0);
  return header;
}

/// Attocube's Daisy: sides and heights each with an entry for its unit.
TextHeader attocubeHeading(const Entries& entries) {
  TextHeader header;
  header.cols = countEntry(entries, "x-pixels");
  header.rows = countEntry(entries, "y-pixels");
  const std::string unit_x = entryText(entries, "x-unit");
  const std::string unit_y = entryText(entries, "y-unit");
  if (!unit_x.empty()) {
    header.width = lengthEntry(entries, "x-length", lengthUnitOf(unit_x));
    header.height =
        lengthEntry(entries, "y-length", lengthUnitOf(unit_y.empty() ? unit_x : unit_y));
  }
  header.unit_z = entryText(entries, "z-unit");
  if (header.unit_z.empty())
    header.unit_doubt = "Daisy's heading states no unit of the heights (\"# z-unit: nm\")";
  header.title = entryText(entries, "display");
  return header;
}

/// NT-MDT's Nova: the sides of a pixel in a unit of their own; heights in theirs, over a scale
/// where it is needed.
TextHeader novaHeading(const Entries& entries) {
  TextHeader header;
  header.cols = countEntry(entries, "nx");
  header.rows = countEntry(entries, "ny");
  const std::string unit_x = entryText(entries, "unit x");
  const std::string unit_y = entryText(entries, "unit y");
  if (!unit_x.empty()) {
    header.pitch_x = lengthEntry(entries, "scale x", lengthUnitOf(unit_x));
    header.pitch_y =
        lengthEntry(entries, "scale y", lengthUnitOf(unit_y.empty() ? unit_x : unit_y));
  }
  header.unit_z = entryText(entries, "unit data");
  if (header.unit_z.empty())
    header.unit_doubt = "Nova's heading states no unit of the heights (\"Unit Data = nm\")";
  const std::string is_needed = lowered(entryText(entries, "datascaleneeded"));
  const double scale = entryText(entries, "scale data").empty()
                           ? 1.0
                           : headingNumber(entryText(entries, "scale data"));
  if (is_needed == "yes") {
    header.scale = scale;
  } else if (is_needed != "no" && scale != 1.0) {
    throw FileError(
        "Nova's heading states 'Scale Data' and does not say by 'DataScaleNeeded = Yes' or 'No' "
        "whether the "
        "numbers are to be multiplied by it");
  }
  return header;
}

}  // namespace

std::optional<TextHeader> makerHeading(const std::vector<TextLine>& heading) {
  if (heading.empty()) return std::nullopt;
  if (startsWith(heading.front().text, kWyko)) return wykoHeading(heading);
  if (isKeyence(heading)) return keyenceHeading(heading);
  const auto begins = [&heading](const char* start) {
    return std::any_of(heading.begin(), heading.end(), [start](const TextLine& line) {
      return startsWith(lowered(headingContent(line.text)), start);
    });
  };
  if (begins("created by nova")) return novaHeading(entriesOf(heading));
  if (begins("daisy ")) return attocubeHeading(entriesOf(heading));
  const Entries entries = begins("file format") ? entriesOf(heading) : Entries();
  if (lowered(entryText(entries, "file format")) == "ascii") return spipHeading(entries);
  return std::nullopt;
}

}  // namespace mems_stiction
