#include "import/plain_number.hpp"

#include <strings.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kGroup = 3;  // digits
constexpr int kMostGroups = 10;    // after the first

bool isDigit(const std::string& text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

/// Length of one of the words at this place, in any case; 0 if there is none.
std::size_t wordLength(const std::string& text, std::size_t at) {
  for (const char* word : {"infinity", "inf", "nan"}) {
    const std::size_t length = std::char_traits<char>::length(word);
    if (at + length <= text.size() && strncasecmp(text.c_str() + at, word, length) == 0)
      return length;
  }
  return 0;
}

/// Fortran writes "1.5D-03".
bool isExponentSign(char c) { return c == 'e' || c == 'E' || c == 'd' || c == 'D'; }

double valueOf(const std::string& text) {
  const std::size_t exponent = text.find_first_of("dD");
  if (exponent == std::string::npos) return plainStrtod(text.c_str());
  return plainStrtod(std::string(text).replace(exponent, 1, "e").c_str());
}

/// How many digits there are from here on, no more than `most`.
std::size_t digitsFrom(const std::string& text, std::size_t at, std::size_t most) {
  std::size_t count = 0;
  while (count < most && isDigit(text, at + count)) ++count;
  return count;
}

std::size_t digitsBefore(const std::string& text, std::size_t at, std::size_t most) {
  std::size_t count = 0;
  while (count < std::min(at, most) && isDigit(text, at - count - 1)) ++count;
  return count;
}

/// True if the mark at `at` stands between groups of thousands: up to three digits before the
/// first, three after each.
/// - @p not_before what cannot stand before the first group: there it would end the decimals of
/// another number
bool groupsAt(const std::string& text, std::size_t at, const std::string& mark,
              const char* not_before) {
  for (int groups = 0; groups < kMostGroups; ++groups) {
    if (digitsFrom(text, at + mark.size(), kGroup + 1) != kGroup) return false;
    const std::size_t head = digitsBefore(text, at, kGroup + 1);
    const std::size_t begin = at - head;
    if (head != kGroup || begin < mark.size() ||
        text.compare(begin - mark.size(), mark.size(), mark) != 0) {
      const bool is_after_decimals =
          begin > 0 && std::string(not_before).find(text[begin - 1]) != std::string::npos;
      return head > 0 && head <= kGroup && text[begin] != '0' && !is_after_decimals;
    }
    at = begin - mark.size();
  }
  return false;
}

/// Where a word that Windows prints for no number ends; the same place if none begins there.
std::size_t windowsNanEnd(const std::string& text, std::size_t at) {
  if (at > 0 && std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0) return at;
  std::size_t end = at;
  if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
  const bool is_old = end + 3 < text.size() && text[end] == '1' &&
                      (text[end + 1] == '.' || text[end + 1] == ',') && text[end + 2] == '#' &&
                      std::isalpha(static_cast<unsigned char>(text[end + 3])) != 0;
  const bool is_new = lowered(text.substr(end, 4)) == "nan(";
  if (!is_old && !is_new) return at;
  end += is_old ? 3 : 4;
  while (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end])) != 0) ++end;
  if (is_old) return end;
  return end < text.size() && text[end] == ')' ? end + 1 : at;
}

}  // namespace

std::size_t numberEnd(const std::string& text, std::size_t at) {
  const std::size_t begin = at;
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  if (const std::size_t length = wordLength(text, at)) return at + length;
  std::size_t digits = 0;
  for (; isDigit(text, at); ++at) ++digits;
  if (at < text.size() && text[at] == '.') {
    ++at;
    for (; isDigit(text, at); ++at) ++digits;
  }
  if (digits == 0) return begin;
  if (at < text.size() && isExponentSign(text[at])) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (isDigit(text, exponent)) {
      for (at = exponent; isDigit(text, at);) ++at;
    }
  }
  return at;
}

double plainNumber(const std::string& text) {
  const bool is_number = !text.empty() && numberEnd(text, 0) == text.size();
  if (!is_number) throw FileError("'" + shownPiece(text) + "' is not a number");
  const bool is_word = text.find_first_of("nN") != std::string::npos;
  const double value = is_word && text.find_first_of("aA") != std::string::npos
                           ? std::numeric_limits<double>::quiet_NaN()
                           : valueOf(text);
  if (std::isinf(value) && !is_word)
    throw FileError("'" + shownPiece(text) + "' is too large for a number");
  return value;
}

bool isMissingWord(const std::string& text) {
  if (text.size() > 8 || text.find_first_of("0123456789") != std::string::npos) return false;
  const std::string word = lowered(text);
  for (const char* missing : {"na", "n/a", "#n/a", "#nv", "null", "none", "bad", "missing",
                              "no data", "nodata", "void", "--", "---", "*"}) {
    if (word == missing) return true;
  }
  return false;
}

std::string shownPiece(const std::string& text, std::size_t at) {
  std::string shown;
  for (; at < text.size() && shown.size() < 24; ++at) {
    const auto byte = static_cast<unsigned char>(text[at]);
    shown += byte >= 0x80 || std::isprint(byte) != 0 ? text[at] : '?';
  }
  return shown;
}

MarkUse markUse(const std::string& number, char mark) {
  const char other = mark == ',' ? '.' : ',';
  const std::size_t first = number.find(mark);
  if (first == std::string::npos) return MarkUse::kAbsent;
  const std::size_t last = number.rfind(mark);
  if (last != first || number.find(other, last) != std::string::npos) return MarkUse::kGroups;
  if (number.find(other) != std::string::npos) return MarkUse::kDecimal;
  const bool is_whole = first + 1 + kGroup == number.size();  // no exponent
  return is_whole && groupsAt(number, first, {mark}, "") ? MarkUse::kEither : MarkUse::kDecimal;
}

std::string withPlainMarks(const std::string& number, char decimal) {
  std::string plain;
  plain.reserve(number.size());
  bool has_decimal = false;
  for (std::size_t at = 0; at < number.size(); ++at) {
    const char sign = number[at];
    if (sign == decimal && !has_decimal) {
      has_decimal = true;
      plain += '.';
    } else if (sign == ',' || sign == '.' || sign == ' ') {
      if (has_decimal || !groupsAt(number, at, {sign}, ",.")) {
        throw FileError("'" + shownPiece(number) + "' is not a number with a decimal " +
                        (decimal == ',' ? "comma" : "point"));
      }
    } else {
      plain += sign;
    }
  }
  return plain;
}

void plainSigns(std::string& text) {
  text = replaced(text, "\xE2\x88\x92", "-");  // a minus that is no hyphen
  struct Mark {
    const char* sign;
    const char* not_before;
  };
  // Blanks also stand between cells, where decimals of either kind may end.
  for (const Mark& mark :
       {Mark{"'", "."}, Mark{"_", "."}, Mark{"\xE2\x80\x99", "."}, Mark{"\xC2\xA0", ".,"},
        Mark{"\xE2\x80\xAF", ".,"}, Mark{"\xE2\x80\x89", ".,"}, Mark{"\xE2\x80\x87", ".,"}}) {
    const std::string sign = mark.sign;
    if (text.find(sign) == std::string::npos) continue;
    std::string plain;
    std::size_t from = 0;
    for (std::size_t at = text.find(sign); at != std::string::npos;
         at = text.find(sign, at + sign.size())) {
      if (!groupsAt(text, at, sign, mark.not_before)) continue;
      plain += text.substr(from, at - from);
      from = at + sign.size();
    }
    text = plain + text.substr(from);
  }
}

void plainNans(std::string& text) {
  if (text.find_first_of("#(") == std::string::npos) return;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t end = windowsNanEnd(text, at);
    if (end > at) text.replace(at, end - at, "nan");
  }
}

bool isGroupBlank(const std::string& text, std::size_t at) { return groupsAt(text, at, " ", ".,"); }

std::string ambiguousMark(const std::string& number) {
  return "'" + shownPiece(number) +
         "' has a mark that may be decimal or group thousands: state decimal_mark: point or comma "
         "in the sidecar "
         "(SCAN.yaml), or as scan/decimal_mark";
}

}  // namespace mems_stiction
