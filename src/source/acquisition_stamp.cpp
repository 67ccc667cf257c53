#include "source/acquisition_stamp.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <optional>
#include <regex>

namespace mems_stiction {
namespace {

constexpr std::int64_t kSecond = 1000000000;  // [ns]
/// Clocks of instruments that nobody has set begin at 1970, 1900 or 1980-01-01.
constexpr std::int64_t kEarliest = 315619200 * kSecond;  // 1980-01-02
constexpr std::int64_t kDay = 86400 * kSecond;

/// The decimals of a second [ns].
std::int64_t decimalsOf(std::string digits) {
  digits.resize(9, '0');
  return digits.empty() ? 0 : std::stoll(digits);
}

/// [ns since 1970], or nothing
std::optional<std::int64_t> timeOf(const std::string& text) {
  static const std::regex form(
      R"((\d{4})-(\d\d)-(\d\d)T(\d\d):(\d\d)(?::(\d\d)(?:\.(\d+))?)?(Z|([+-])(\d\d):?(\d\d))?)");
  std::smatch match;
  if (text.size() > 64 || !std::regex_match(text, match, form)) return std::nullopt;
  std::tm parts{};
  parts.tm_year = std::stoi(match[1]) - 1900;
  parts.tm_mon = std::stoi(match[2]) - 1;
  parts.tm_mday = std::stoi(match[3]);
  parts.tm_hour = std::stoi(match[4]);
  parts.tm_min = std::stoi(match[5]);
  parts.tm_sec = match[6].matched ? std::stoi(match[6]) : 0;
  parts.tm_isdst = -1;
  std::int64_t seconds = 0;
  if (match[8].matched) {
    seconds = timegm(&parts);
    if (match[9].matched) {
      const std::int64_t ahead = 3600 * std::stoi(match[10]) + 60 * std::stoi(match[11]);
      seconds -= match[9] == "+" ? ahead : -ahead;
    }
  } else {
    seconds = mktime(&parts);
  }
  if (seconds < 0 || seconds > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return seconds * kSecond + (match[7].matched ? decimalsOf(match[7]) : 0);
}

}  // namespace

std::uint64_t acquisitionStamp(const std::string& acquisition_time, std::int64_t file_time) {
  constexpr std::int64_t kLargest =
      std::int64_t{std::numeric_limits<std::uint32_t>::max()} * kSecond;
  const std::optional<std::int64_t> stated = timeOf(acquisition_time);
  const std::int64_t tomorrow = std::int64_t{std::time(nullptr)} * kSecond + kDay;
  const bool makes_sense = stated && *stated >= kEarliest && *stated < tomorrow;
  return static_cast<std::uint64_t>(
      std::clamp<std::int64_t>(makes_sense ? *stated : file_time, 1, kLargest));
}

}  // namespace mems_stiction
