#include "import/header_lines.hpp"

#include <algorithm>

#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kMostDigits = 12;

std::string withoutNul(const std::string& text) { return trimmed(text, std::string(" \t\r\0", 4)); }

}  // namespace

std::optional<std::uint64_t> countIn(const std::string& text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
  if (end == begin || end - begin > kMostDigits) return std::nullopt;
  return std::stoull(text.substr(begin, end - begin));
}

HeaderLines::HeaderLines(const std::string& text, const std::string& separator) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t stop = std::min(text.find('\n', at), text.size());
    const std::string line = withoutNul(text.substr(at, stop - at));
    at = stop + 1;
    const std::size_t sign = line.find(separator);
    if (sign == std::string::npos) continue;
    values_[lowered(withoutNul(line.substr(0, sign)))].push_back(
        withoutNul(line.substr(sign + separator.size())));
  }
}

std::size_t HeaderLines::times(const std::string& key) const {
  const auto found = values_.find(lowered(key));
  return found == values_.end() ? 0 : found->second.size();
}

std::string HeaderLines::value(const std::string& key) const {
  const auto found = values_.find(lowered(key));
  return found == values_.end() ? "" : found->second.front();
}

std::uint64_t HeaderLines::count(const std::string& key) const {
  const auto found = countIn(value(key));
  if (!found) {
    throw FileError("the header states '" + key + "' as '" + shownPiece(value(key)) +
                    "', which is no count: damaged");
  }
  return *found;
}

}  // namespace mems_stiction
