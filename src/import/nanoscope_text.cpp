#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "import/file_bytes.hpp"
#include "import/file_statements.hpp"
#include "import/format_readers.hpp"
#include "import/header_lines.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kMostColumns = 64;

/// What the heading states of the scan; the first entry of a key counts, as the file lists the scan
/// before its images.
struct Heading {
  std::size_t cols = 0, rows = 0;
  double width = 0.0, height = 0.0;  ///< [m]
  std::vector<std::string> names;    ///< of the columns, "Height(nm)"
  FileStatements statements;
};

std::string withoutQuotes(const std::string& text) { return trimmed(text, " \t\r\""); }

std::vector<std::string> bareWords(const std::string& text) {
  std::vector<std::string> words = wordsOf(text);
  for (std::string& word : words) word = withoutQuotes(word);
  return words;
}

/// "500 nm", "500 250 nm": one or two sides and their unit.
void readSize(const std::string& value, Heading& heading) {
  const std::vector<std::string> words = bareWords(value);
  if (words.size() < 2 || words.size() > 3) return;
  const auto unit = lengthUnit(words.back() == "~m" ? "um" : words.back());
  if (!unit) throw FileError("the scan size '" + shownPiece(value) + "' is no length");
  heading.width = plainNumber(words[0]) * *unit;
  heading.height = words.size() == 3 ? plainNumber(words[1]) * *unit : 0.0;
}

void readEntry(const std::string& line, Heading& heading) {
  const std::size_t colon = line.find(": ");
  if (colon == std::string::npos) return;
  const std::string key = lowered(line.substr(1, colon - 1));
  const std::string value = withoutQuotes(line.substr(colon + 2));
  const auto count = [&value] { return static_cast<std::size_t>(countIn(value).value_or(0)); };
  heading.statements.emplace(key, value);
  if (key == "samps/line" && heading.cols == 0) heading.cols = count();
  if (key == "lines" && heading.rows == 0) heading.rows = count();
  if (key == "scan size" && heading.width == 0.0) readSize(value, heading);
}

/// "Height_Sensor(nm)": name and unit
bool isColumnName(const std::string& word) {
  const std::size_t open = word.find('(');
  return open != std::string::npos && open > 0 && word.back() == ')' &&
         std::isalpha(static_cast<unsigned char>(word[0])) != 0;
}

FileChannel channelOf(const std::string& name, const Heading& heading, int id) {
  const std::size_t open = name.find('(');
  FileChannel channel;
  channel.id = id;
  channel.title = name.substr(0, open);
  std::replace(channel.title.begin(), channel.title.end(), '_', ' ');
  channel.unit_z = name.substr(open + 1, name.size() - open - 2);
  channel.values.create(static_cast<int>(heading.rows), static_cast<int>(heading.cols), CV_64FC1);
  channel.width = heading.width;
  channel.height = heading.height > 0.0 ? heading.height
                                        : heading.width * static_cast<double>(heading.rows) /
                                              static_cast<double>(heading.cols);
  if (channel.width > 0.0) channel.unit_xy = "m";
  return channel;
}

double numberOf(std::string word) {
  plainNans(word);
  const double number =
      isMissingWord(word) ? std::numeric_limits<double>::quiet_NaN() : plainNumber(word);
  return std::isfinite(number) ? number : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<FileChannel> parseNanoscopeText(const std::string& bytes) {
  std::istringstream stream(toUtf8(bytes));
  Heading heading;
  std::string line;
  int number = 0;
  while (heading.names.empty() && std::getline(stream, line)) {
    ++number;
    const std::string text = withoutQuotes(line);
    if (text.empty()) continue;
    if (text[0] == '\\') {
      readEntry(text, heading);
      continue;
    }
    const std::vector<std::string> words = bareWords(text);
    if (words.size() > kMostColumns || !std::all_of(words.begin(), words.end(), isColumnName)) {
      throw FileError("line " + std::to_string(number) + ": '" + shownPiece(text) +
                      "' does not name the columns: export with the channels' names and units");
    }
    heading.names = words;
  }
  if (heading.names.empty()) throw FileError("the file ends before its numbers");
  if (heading.cols < 2 || heading.rows < 2)
    throw FileError("the heading states no Samps/line and Lines");
  checkPixelCount(heading.cols, heading.rows);
  const ScanIdentity identity = identityFrom(heading.statements);
  std::vector<FileChannel> channels;
  for (const std::string& name : heading.names) {
    channels.push_back(channelOf(name, heading, static_cast<int>(channels.size())));
    channels.back().identity = identity;
  }
  std::size_t pixel = 0;
  const auto setNext = [&](FileChannel& channel, const std::string& word) {
    channel.values.at<double>(static_cast<int>(pixel / heading.cols),
                              static_cast<int>(pixel % heading.cols)) = numberOf(word);
  };
  while (std::getline(stream, line)) {
    ++number;
    const std::vector<std::string> words = bareWords(line);
    if (words.empty()) continue;
    const std::string where = "line " + std::to_string(number) + ": ";
    const bool is_line = channels.size() == 1 && words.size() == heading.cols;  // of a matrix
    if (!is_line && words.size() != channels.size()) {
      throw FileError(where + std::to_string(words.size()) + " numbers under " +
                      std::to_string(channels.size()) +
                      " names: the file is cut off, or neither points in columns nor the matrix of "
                      "one channel");
    }
    if (pixel == heading.cols * heading.rows)
      throw FileError(where + "more points than the heading states");
    for (std::size_t at = 0; at < words.size(); ++at) {
      try {
        setNext(channels[is_line ? 0 : at], words[at]);
      } catch (const FileError& error) {
        throw FileError(where + error.what() + ", column " + std::to_string(at + 1));
      }
      if (is_line) ++pixel;
    }
    if (!is_line) ++pixel;
  }
  if (pixel != heading.cols * heading.rows) {
    throw FileError("the heading states " + std::to_string(heading.cols) + " x " +
                    std::to_string(heading.rows) + " points, the file has " +
                    std::to_string(pixel) + ": it is cut off");
  }
  for (FileChannel& channel : channels) {
    const auto unit = heightUnit(channel.unit_z);
    if (!unit) continue;
    channel.values *= *unit;
    channel.unit_z = "m";
  }
  return channels;
}

}  // namespace mems_stiction
