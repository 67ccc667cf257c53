#include "import/acquisition_time.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <optional>
#include <regex>
#include <vector>

#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kLongestDate = 64;
constexpr std::array<const char*, 12> kMonths = {"jan", "feb", "mar", "apr", "may", "jun",
                                                 "jul", "aug", "sep", "oct", "nov", "dec"};
constexpr std::array<const char*, 7> kDays = {"mon", "tue", "wed", "thu", "fri", "sat", "sun"};

/// What the words of a text have said so far.
struct Reading {
  int year = 0, month = 0, day = 0;
  bool has_time = false;
  int hour = 0, minute = 0;
  std::string seconds;  ///< ":51.25"
  std::string half;     ///< "am", "pm"
  std::string zone;     ///< "Z", "+01:00"
};

/// The place of a word in a table of words of three letters, from 1; "December" is "dec".
template <std::size_t Count>
int placeIn(const std::array<const char*, Count>& table, const std::string& word) {
  const auto found = std::find(table.begin(), table.end(), lowered(word).substr(0, 3));
  return found == table.end() ? 0 : static_cast<int>(found - table.begin()) + 1;
}

bool setDate(Reading& reading, int year, int month, int day) {
  if (reading.year != 0) return false;
  reading.year = year;
  reading.month = month;
  reading.day = day;
  return true;
}

/// "2011-10-20", "2011/10/20", "20.10.2011", "10/20/2011"; false also where day and month may be
/// either.
bool readDate(const std::string& word, Reading& reading) {
  static const std::regex year_first(R"((\d{4})[-/.:](\d{1,2})[-/.:](\d{1,2}))");
  static const std::regex year_last(R"((\d{1,2})([-/.])(\d{1,2})\2(\d{4}))");
  std::smatch match;
  if (std::regex_match(word, match, year_first)) {
    return setDate(reading, std::stoi(match[1]), std::stoi(match[2]), std::stoi(match[3]));
  }
  if (!std::regex_match(word, match, year_last)) return false;
  const int first = std::stoi(match[1]);
  const int second = std::stoi(match[3]);
  const int year = std::stoi(match[4]);
  if (match[2] == "." || first > 12 || first == second)
    return setDate(reading, year, second, first);
  return second > 12 && setDate(reading, year, first, second);
}

/// "15:48", "15:48:33.25", with "Z" or "+01:00" behind it
bool readTime(const std::string& word, Reading& reading) {
  static const std::regex pattern(R"((\d{1,2}):(\d{2})(:\d{2}(\.\d+)?)?(Z|[-+]\d{2}:?\d{2})?)");
  std::smatch match;
  if (reading.has_time || !std::regex_match(word, match, pattern)) return false;
  reading.has_time = true;
  reading.hour = std::stoi(match[1]);
  reading.minute = std::stoi(match[2]);
  reading.seconds = match[3];
  if (match[5].length() > 0) reading.zone = match[5];
  if (reading.zone.size() == 5) reading.zone.insert(3, ":");
  return true;
}

bool readWord(const std::string& word, Reading& reading) {
  const std::string lower = lowered(word);
  if ((lower == "am" || lower == "pm") && reading.half.empty()) {
    reading.half = lower;
    return true;
  }
  if ((lower == "utc" || lower == "gmt" || lower == "z") && reading.zone.empty()) {
    reading.zone = "Z";
    return true;
  }
  if (std::isalpha(static_cast<unsigned char>(word[0])) != 0) {
    const int month = placeIn(kMonths, word);
    if (month == 0 || reading.month != 0) return placeIn(kDays, word) != 0;
    reading.month = month;
    return true;
  }
  if (!std::all_of(word.begin(), word.end(),
                   [](unsigned char letter) { return std::isdigit(letter) != 0; })) {
    return readDate(word, reading) || readTime(word, reading);
  }
  int& number = word.size() == 4 ? reading.year : reading.day;
  if (word.size() > 4 || word.size() == 3 || number != 0) return false;
  number = std::stoi(word);
  return true;
}

bool isDate(const Reading& reading) {
  if (reading.year == 0 || reading.month < 1 || reading.month > 12) return false;
  const bool is_leap =
      reading.year % 4 == 0 && (reading.year % 100 != 0 || reading.year % 400 == 0);
  const int days =
      reading.month == 2 ? (is_leap ? 29 : 28) : 30 + (reading.month + reading.month / 8) % 2;
  return reading.day >= 1 && reading.day <= days;
}

/// @return false for a time of day that there is none of
bool setHour(Reading& reading) {
  if (!reading.half.empty()) {
    if (!reading.has_time || reading.hour < 1 || reading.hour > 12) return false;
    reading.hour = reading.hour % 12 + (reading.half == "pm" ? 12 : 0);
  }
  return reading.hour < 24 && reading.minute < 60 &&
         (reading.seconds.size() < 3 || reading.seconds[1] < '6');
}

/// The date, the time and their parts.
std::vector<std::string> partsOf(const std::string& text) {
  static const std::regex between("[T_](?=\\d{2}:)|[\\s,;]+|(\\d)\\s*(?=[AaPp][Mm]\\b)");
  return wordsOf(std::regex_replace(text, between, "$1 "));
}

/// None where it is no date, or might be two.
std::optional<Reading> readingOf(const std::string& text) {
  Reading reading;
  for (const std::string& word : partsOf(text)) {
    if (!readWord(word, reading)) return std::nullopt;
  }
  if (!isDate(reading) || !setHour(reading)) return std::nullopt;
  return reading;
}

/// A day, whichever of its numbers is which, and not "0. 0. 0".
bool hasDate(const std::string& text) {
  static const std::regex pattern(R"(\d+\s*[-/.]\s*\d+\s*[-/.]\s*\d+)");
  return std::regex_search(text, pattern) && text.find_first_of("123456789") != std::string::npos;
}

}  // namespace

std::string acquisitionTime(const std::string& text) {
  if (text.size() > kLongestDate) return "";
  const std::optional<Reading> reading = readingOf(text);
  if (!reading) return hasDate(text) ? text : "";
  if (reading->year <= 1970 && reading->month == 1 && reading->day == 1) return "";
  char date[48];
  std::snprintf(date, sizeof date, "%04d-%02d-%02d", reading->year, reading->month, reading->day);
  if (!reading->has_time) return date;
  char time[16];
  std::snprintf(time, sizeof time, "T%02d:%02d", reading->hour, reading->minute);
  return date + (time + reading->seconds) + reading->zone;
}

}  // namespace mems_stiction
