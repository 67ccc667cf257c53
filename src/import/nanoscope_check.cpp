#include "import/nanoscope_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

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

constexpr std::uint64_t kWideVersion = 0x09200000;  // since then numbers have four bytes
constexpr std::size_t kMostHeader = 1 << 20;        // [bytes]
constexpr double kAgreement = 0.01;

/// A part of the header between two lines "\*Name".
struct List {
  std::string name;
  HeaderLines lines;
};

std::vector<List> listsOf(const std::string& bytes) {
  const std::string header = bytes.substr(0, std::min({bytes.find('\x1a'), bytes.find('\0'), kMostHeader}));
  std::vector<List> lists;
  for (std::size_t at = header.find("\\*"); at != std::string::npos;) {
    const std::size_t next = header.find("\n\\*", at);
    const std::string part = header.substr(at + 2, next == std::string::npos ? next : next - at - 1);
    std::string name = part.substr(0, std::min(part.find_first_of("\r\n"), part.size()));
    std::string rest = part.substr(name.size());
    rest.erase(std::remove(rest.begin(), rest.end(), '\\'), rest.end());
    lists.push_back({name, HeaderLines(rest, ": ")});
    at = next == std::string::npos ? next : next + 1;
  }
  return lists;
}

bool isImage(const List& list) {
  return endsWith(list.name, "image list") && list.name.find("force") == std::string::npos;
}

struct Size {
  double x = 0.0, y = 0.0;  ///< [m]; 0 = not stated
};

/// "10 10 ~m", or "10000 nm" for both
Size scanSize(const HeaderLines& lines) {
  const std::string text = lines.value("Scan Size");
  const std::size_t first = numberEnd(text, 0);
  const std::size_t begin = std::min(text.find_first_not_of(' ', first), text.size());
  const std::size_t second = numberEnd(text, begin);
  std::string unit_text = text.substr(std::max(second, first));
  std::replace(unit_text.begin(), unit_text.end(), '~', 'u');
  const auto unit = lengthUnit(unit_text);
  if (first == 0 || !unit) return {};
  const double x = std::strtod(text.c_str(), nullptr) * *unit;
  return {x, second > begin ? std::strtod(text.c_str() + begin, nullptr) * *unit : x};
}

bool differ(double a, double b) { return !(std::abs(a - b) <= kAgreement * std::max(std::abs(a), std::abs(b))); }

void checkImage(const List& list, std::uint64_t length, std::uint64_t bytes_each) {
  const HeaderLines& lines = list.lines;
  if (!lines.has("Number of lines") || !lines.has("Samps/line")) return;
  const std::uint64_t cols = lines.count("Samps/line");
  const std::uint64_t rows = lines.count("Number of lines");
  if (cols > kMostHeader || rows > kMostHeader || cols * rows * bytes_each != length) {
    throw FileError("the NanoScope header contradicts itself: " + std::to_string(cols) + " samples a line, " +
                    std::to_string(rows) + " lines and " + std::to_string(bytes_each) + " bytes each are not the " +
                    std::to_string(length) + " bytes that it states for the image");
  }
  const Size size = scanSize(lines);
  const bool is_square = lines.value("Aspect Ratio") == "1:1";
  if (is_square && size.x > 0.0 && differ(size.x / static_cast<double>(cols), size.y / static_cast<double>(rows))) {
    throw FileError("the NanoScope header contradicts itself: aspect ratio 1:1, but " + std::to_string(cols) +
                    " samples a line and " + std::to_string(rows) + " lines over a scan size of " +
                    shownPiece(lines.value("Scan Size")));
  }
}

/// "V [Sens. Zsens] (0.0067 V/LSB) 330.0000 V" [V]; 0 = not stated
double volts(const std::string& text) {
  const std::size_t begin = text.find(')');
  return begin == std::string::npos ? 0.0 : std::strtod(text.c_str() + begin + 1, nullptr);
}

/// "V 34.55678 nm/V" [m/V]; 0 = not stated
double metresPerVolt(const std::string& text) {
  const std::size_t end = text.find("/V");
  if (end == std::string::npos || !startsWith(text, "V ")) return 0.0;
  std::string length = text.substr(2, end - 2);
  std::replace(length.begin(), length.end(), '~', 'u');
  const auto stated = statedLength(length);
  const auto unit = stated ? lengthUnit(stated->unit) : std::nullopt;
  return unit ? stated->number * *unit : 0.0;
}

bool isNanoscope(const std::string& bytes) {
  return startsWith(bytes, "\\*File list") || startsWith(bytes, "\\*Force file list");
}

void checkParts(const std::vector<List>& lists, std::size_t size) {
  const std::string version = lists.front().lines.value("Version");
  const std::uint64_t bytes_each = std::strtoull(version.c_str(), nullptr, 16) >= kWideVersion ? 4 : 2;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> parts;
  for (const List& list : lists) {
    if (!list.lines.has("Data offset") || !list.lines.has("Data length")) continue;
    const std::uint64_t offset = list.lines.count("Data offset");
    const std::uint64_t length = list.lines.count("Data length");
    if (isImage(list)) checkImage(list, length, bytes_each);
    parts.emplace_back(offset, offset + length);
  }
  if (parts.empty()) return;
  std::sort(parts.begin(), parts.end());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].first < parts[i - 1].second) {
      throw FileError("the NanoScope header contradicts itself: the data at " + std::to_string(parts[i].first) +
                      " begin inside of those before, which end at " + std::to_string(parts[i - 1].second));
    }
  }
  demandLength("NanoScope", size, parts.back().second);
}

ScanIdentity identityOf(const std::vector<List>& lists) {
  FileStatements statements;
  for (const List& list : lists) {
    for (const char* key : {"Date", "Microscope", "Scanner type", "Head Type", "Serial Number", "Operator"}) {
      if (list.lines.has(key)) statements.emplace(key, list.lines.value(key));
    }
  }
  return identityFrom(statements);
}

double reachOf(const std::vector<List>& lists) {
  std::string limit;
  for (const List& list : lists) {
    for (const char* key : {"@1:Z limit", "@1:ZLimit"}) {
      if (limit.empty()) limit = list.lines.value(key);
    }
  }
  const std::size_t begin = limit.find('[');
  const std::size_t end = limit.find(']');
  if (begin == std::string::npos || end == std::string::npos || end < begin) return 0.0;
  const std::string scale = "@" + limit.substr(begin + 1, end - begin - 1);
  for (const List& list : lists) {
    const double reach = volts(limit) * metresPerVolt(list.lines.value(scale));
    if (reach > 0.0) return reach;
  }
  return 0.0;
}

std::vector<std::string> notesOf(const std::vector<List>& lists) {
  Size whole;
  for (const List& list : lists) {
    const Size size = scanSize(list.lines);
    if (!isImage(list) && endsWith(list.name, "scan list") && size.x > 0.0) whole = size;
    if (!isImage(list) || !(whole.x > 0.0) || !(size.x > 0.0) || !differ(size.x, whole.x)) continue;
    return {"the header states a scan size of " + numberText(whole.x) + " m for the scan and " + numberText(size.x) +
            " m for its image, which is taken"};
  }
  return {};
}

}  // namespace

NanoscopeStatements checkedNanoscope(const std::string& bytes) {
  if (!isNanoscope(bytes)) return {};
  const std::vector<List> lists = listsOf(bytes);
  checkParts(lists, bytes.size());
  return {identityOf(lists), reachOf(lists), notesOf(lists)};
}

}  // namespace mems_stiction
