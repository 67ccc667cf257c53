#include "import/nanoscope_header.hpp"

#include <algorithm>
#include <cstdlib>

#include "errors/plain_format.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "numeric/words.hpp"

namespace mems_stiction::nanoscope {
namespace {

constexpr std::uint64_t kWideVersion = 0x09200000;  // since then numbers have four bytes

}  // namespace

bool isNanoscope(const std::string& bytes) {
  return startsWith(bytes, "\\*File list") || startsWith(bytes, "\\*Force file list");
}

std::vector<List> listsOf(const std::string& bytes) {
  const std::string header =
      bytes.substr(0, std::min({bytes.find('\x1a'), bytes.find('\0'), kMostHeader}));
  std::vector<List> lists;
  for (std::size_t at = header.find("\\*"); at != std::string::npos;) {
    const std::size_t next = header.find("\n\\*", at);
    const std::string part =
        header.substr(at + 2, next == std::string::npos ? next : next - at - 1);
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

std::uint64_t bytesOfNumber(const std::vector<List>& lists) {
  const std::string version = lists.empty() ? "" : lists.front().lines.value("Version");
  return std::strtoull(version.c_str(), nullptr, 16) >= kWideVersion ? 4 : 2;
}

Size scanSize(const HeaderLines& lines) {
  const std::string text = lines.value("Scan Size");
  const std::size_t first = numberEnd(text, 0);
  const std::size_t begin = std::min(text.find_first_not_of(' ', first), text.size());
  const std::size_t second = numberEnd(text, begin);
  std::string unit_text = text.substr(std::max(second, first));
  std::replace(unit_text.begin(), unit_text.end(), '~', 'u');
  const auto unit = lengthUnit(unit_text);
  if (first == 0 || !unit) return {};
  const double x = plainStrtod(text.c_str()) * *unit;
  return {x, second > begin ? plainStrtod(text.c_str() + begin) * *unit : x};
}

double hardValue(const std::string& text) {
  const std::size_t begin = text.find(')');
  return begin == std::string::npos ? 0.0 : plainStrtod(text.c_str() + begin + 1);
}

double metresPerVolt(const std::string& text) {
  const std::size_t end = text.find("/V");
  if (end == std::string::npos || !startsWith(text, "V ")) return 0.0;
  std::string length = text.substr(2, end - 2);
  std::replace(length.begin(), length.end(), '~', 'u');
  const auto stated = statedLength(length);
  const auto unit = stated ? heightUnit(stated->unit) : std::nullopt;
  return unit ? stated->number * *unit : 0.0;
}

}  // namespace mems_stiction::nanoscope
