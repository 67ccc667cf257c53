#include "import/nanoscope_check.hpp"

#include <algorithm>
#include <cmath>

#include "import/file_checks.hpp"
#include "import/file_statements.hpp"
#include "import/nanoscope_header.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

using namespace nanoscope;

constexpr double kAgreement = 0.01;

bool differ(double a, double b) {
  return !(std::abs(a - b) <= kAgreement * std::max(std::abs(a), std::abs(b)));
}

void checkImage(const List& list, std::uint64_t length, std::uint64_t bytes_each) {
  const HeaderLines& lines = list.lines;
  if (!lines.has("Number of lines") || !lines.has("Samps/line")) return;
  const std::uint64_t cols = lines.count("Samps/line");
  const std::uint64_t rows = lines.count("Number of lines");
  if (cols > kMostHeader || rows > kMostHeader || cols * rows * bytes_each != length) {
    throw FileError("the NanoScope header contradicts itself: " + std::to_string(cols) +
                    " samples a line, " + std::to_string(rows) + " lines and " +
                    std::to_string(bytes_each) + " bytes each are not the " +
                    std::to_string(length) + " bytes that it states for the image");
  }
  const Size size = scanSize(lines);
  const bool is_square = lines.value("Aspect Ratio") == "1:1";
  if (is_square && size.x > 0.0 &&
      differ(size.x / static_cast<double>(cols), size.y / static_cast<double>(rows))) {
    throw FileError("the NanoScope header contradicts itself: aspect ratio 1:1, but " +
                    std::to_string(cols) + " samples a line and " + std::to_string(rows) +
                    " lines over a scan size of " + shownPiece(lines.value("Scan Size")));
  }
}

void checkParts(const std::vector<List>& lists, std::size_t size) {
  const std::uint64_t bytes_each = bytesOfNumber(lists);
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
      throw FileError(
          "the NanoScope header contradicts itself: the data at " + std::to_string(parts[i].first) +
          " begin inside of those before, which end at " + std::to_string(parts[i - 1].second));
    }
  }
  demandLength("NanoScope", size, parts.back().second);
}

ScanIdentity identityOf(const std::vector<List>& lists) {
  FileStatements statements;
  for (const List& list : lists) {
    for (const char* key :
         {"Date", "Microscope", "Scanner type", "Head Type", "Serial Number", "Operator"}) {
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
    const double reach = hardValue(limit) * metresPerVolt(list.lines.value(scale));
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
    return {"the header states a scan size of " + numberText(whole.x) + " m for the scan and " +
            numberText(size.x) + " m for its image, which is taken"};
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
