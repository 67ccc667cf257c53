#include "import/format_readers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/file_checks.hpp"
#include "import/file_statements.hpp"
#include "import/header_lines.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kEnd = "[Header end]";
constexpr const char* kBlanks = " \t\r";

/// "Section/Key" to value.
std::map<std::string, std::string> readHeader(const std::string& bytes, std::size_t end) {
  std::map<std::string, std::string> header;
  std::string section;
  for (std::size_t at = 0; at < end;) {
    const std::size_t stop = std::min(bytes.find('\n', at), end);
    const std::string line = trimmed(toUtf8(bytes.substr(at, stop - at)), kBlanks);
    at = stop + 1;
    if (!line.empty() && line[0] == '[') section = line.substr(1, line.find(']') - 1);
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos)
      header[section + "/" + line.substr(0, colon)] = trimmed(line.substr(colon + 1), kBlanks);
  }
  return header;
}

const std::string& entry(const std::map<std::string, std::string>& header, const std::string& key) {
  const auto found = header.find(key);
  if (found == header.end()) throw FileError("the WSxM header does not state '" + key + "'");
  return found->second;
}

std::uint64_t countOf(const std::map<std::string, std::string>& header, const std::string& key) {
  const double count = plainNumber(entry(header, key));
  if (!(count >= 1.0 && count <= 1e9))
    throw FileError("the WSxM header states " + key + " " + entry(header, key));
  return static_cast<std::uint64_t>(count);
}

/// A side of the image [m]. @throw FileError
double sideOf(const std::map<std::string, std::string>& header, const std::string& key) {
  const auto stated = statedLength(entry(header, key));
  const auto unit = stated ? lengthUnit(stated->unit) : std::nullopt;
  if (!unit || !(stated->number > 0.0)) {
    throw FileError("the WSxM header states " + key + " '" + shownPiece(entry(header, key)) +
                    "', which is no length");
  }
  return stated->number * *unit;
}

enum class NumberType { kShort, kFloat, kDouble };

NumberType typeOf(const std::map<std::string, std::string>& header) {
  const auto found = header.find("General Info/Image Data Type");
  if (found == header.end() || found->second == "short" || found->second == "integer")
    return NumberType::kShort;
  if (found->second == "float") return NumberType::kFloat;
  if (found->second == "double") return NumberType::kDouble;
  throw FileError("the WSxM data type '" + shownPiece(found->second) + "' is not known");
}

std::size_t bytesOf(NumberType type) {
  return type == NumberType::kShort ? 2 : type == NumberType::kFloat ? 4 : 8;
}

double next(ByteCursor& cursor, NumberType type) {
  if (type == NumberType::kShort) return cursor.number<std::int16_t>();
  return type == NumberType::kFloat ? static_cast<double>(cursor.number<float>())
                                    : cursor.number<double>();
}

/// The header states the smallest and the largest number, rounded to six digits.
void checkExtreme(const std::map<std::string, std::string>& header, const std::string& key,
                  double found, double range) {
  const auto stated = header.find(key);
  if (stated == header.end() || numberEnd(stated->second, 0) != stated->second.size()) return;
  const double number = plainNumber(stated->second);
  if (std::abs(number - found) <= 1e-4 * std::max(std::abs(range), std::abs(number))) return;
  throw FileError("the WSxM header states " + key + " " + shownPiece(stated->second) +
                  ", the data have " + numberText(found) + ": damaged");
}

}  // namespace

bool isWsxmImage(const std::string& start) {
  const std::size_t line = start.find('\n');
  return startsWith(start, "WSxM file copyright") && line != std::string::npos &&
         start.compare(line + 1, 14, "SxM Image file") == 0;
}

FileChannel parseWsxm(const std::string& bytes) {
  const std::size_t header_end = bytes.find(kEnd);
  if (header_end == std::string::npos) throw FileError("the WSxM header has no end: cut off");
  const auto header = readHeader(bytes, header_end);
  const std::uint64_t cols = countOf(header, "General Info/Number of columns");
  const std::uint64_t rows = countOf(header, "General Info/Number of rows");
  checkPixelCount(cols, rows);
  const NumberType type = typeOf(header);
  const std::uint64_t needed = cols * rows * bytesOf(type);
  const auto stated_size = header.find("/Image header size");
  const std::size_t line_end = bytes.find('\n', header_end);
  std::uint64_t begin = stated_size == header.end() ? 0 : countIn(stated_size->second).value_or(0);
  if (begin < header_end)
    begin = line_end == std::string::npos ? bytes.size() : line_end + 1;  // not filled in
  demandLength("WSxM", bytes.size(), begin + needed);

  FileChannel channel;
  const auto title = header.find("General Info/Acquisition channel");
  if (title != header.end()) channel.title = title->second;
  channel.identity = identityFrom(header);
  channel.width = sideOf(header, "Control/X Amplitude");
  channel.height = header.count("Control/Y Amplitude") != 0 ? sideOf(header, "Control/Y Amplitude")
                                                            : channel.width;
  channel.unit_xy = "m";
  channel.values.create(static_cast<int>(rows), static_cast<int>(cols), CV_64FC1);
  ByteCursor data(bytes.data() + begin, static_cast<std::size_t>(needed), "the WSxM file");
  for (int row = channel.values.rows - 1; row >= 0; --row) {
    double* line = channel.values.ptr<double>(row);
    for (int col = channel.values.cols - 1; col >= 0; --col) line[col] = next(data, type);
  }

  double least = 0.0;
  double most = 0.0;
  cv::minMaxLoc(channel.values, &least, &most);
  checkExtreme(header, "Miscellaneous/Minimum", least, most - least);
  checkExtreme(header, "Miscellaneous/Maximum", most, most - least);

  const std::string& amplitude_text = entry(header, "General Info/Z Amplitude");
  const auto amplitude = statedLength(amplitude_text);
  if (!amplitude)
    throw FileError("the WSxM header states the z amplitude '" + shownPiece(amplitude_text) + "'");
  const auto unit = heightUnit(amplitude->unit);
  channel.unit_z = unit ? "m" : amplitude->unit;
  double scale = unit.value_or(1.0);
  if (type == NumberType::kShort && most > least) scale *= amplitude->number / (most - least);
  channel.values *= scale;
  return channel;
}

}  // namespace mems_stiction
