#include "mems_stiction/height_map/text_grid.hpp"

#include <locale.h>
#include <stdlib.h>

#include <cctype>
#include <fstream>
#include <limits>
#include <vector>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {
namespace {

/// Numbers have a decimal point whatever locale the process runs in.
class PlainLocale {
 public:
  PlainLocale() : locale_(newlocale(LC_NUMERIC_MASK, "C", static_cast<locale_t>(nullptr))) {}
  ~PlainLocale() { freelocale(locale_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

  double parse(const char* text, char** end) const { return strtod_l(text, end, locale_); }

 private:
  locale_t locale_;
};

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool isDelimiter(char c) { return c == ',' || c == ';'; }

/// Appends the cells of one line. @return where text begins that is no number, or null.
const char* appendCells(const char* text, const PlainLocale& locale, std::vector<double>& cells) {
  bool cell_is_open = true;  // a delimiter now would end an empty cell
  for (;;) {
    while (isBlank(*text)) ++text;
    if (*text == '\0') return nullptr;
    if (isDelimiter(*text)) {
      if (cell_is_open) cells.push_back(std::numeric_limits<double>::quiet_NaN());
      cell_is_open = true;
      ++text;
      continue;
    }
    char* end = nullptr;
    cells.push_back(locale.parse(text, &end));
    if (end == text || !(*end == '\0' || isBlank(*end) || isDelimiter(*end))) return text;
    text = end;
    cell_is_open = false;
  }
}

/// A short piece of what stands there, for the message, without control characters.
std::string piece(const char* text) {
  std::string shown;
  for (; *text != '\0' && shown.size() < 24 && !isBlank(*text) && !isDelimiter(*text); ++text) {
    shown += std::isprint(static_cast<unsigned char>(*text)) != 0 ? *text : '?';
  }
  return shown;
}

}  // namespace

cv::Mat readTextGrid(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path + ": cannot be opened");
  const PlainLocale locale;
  std::vector<double> cells;
  std::size_t cols = 0;
  int rows = 0;
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    const std::string where = path + ": line " + std::to_string(line_number) + ": ";
    if (line.find('\0') != std::string::npos) throw FileError(where + "binary data where numbers are expected");
    line.erase(std::min(line.find('#'), line.size()));
    const std::size_t before = cells.size();
    if (const char* wrong = appendCells(line.c_str(), locale, cells)) {
      throw FileError(where + "'" + piece(wrong) + "' is not a number");
    }
    const std::size_t count = cells.size() - before;
    if (count == 0) continue;
    if (rows > 0 && count != cols) {
      throw FileError(where + std::to_string(count) + " cells, the lines before it have " + std::to_string(cols) +
                      ": the file is cut off, or not a grid");
    }
    cols = count;
    ++rows;
  }
  if (stream.bad()) throw FileError(path + ": cannot be read");
  if (rows < 2 || cols < 2) {
    throw FileError(path + ": a grid needs at least 2 x 2 numbers, found " + std::to_string(cols) + " x " +
                    std::to_string(rows));
  }
  if (cols > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw FileError(path + ": too many columns");
  return cv::Mat(rows, static_cast<int>(cols), CV_64FC1, cells.data()).clone();
}

}  // namespace mems_stiction
