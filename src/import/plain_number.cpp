#include "mems_stiction/import/plain_number.hpp"

#include <locale.h>
#include <stdlib.h>
#include <strings.h>

#include <cctype>
#include <cmath>
#include <limits>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {
namespace {

locale_t pointLocale() {
  static const locale_t kLocale = newlocale(LC_NUMERIC_MASK, "C", static_cast<locale_t>(nullptr));
  return kLocale;
}

bool isDigit(const std::string& text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

/// Length of one of the words at this place, in any case; 0 if there is none.
std::size_t wordLength(const std::string& text, std::size_t at) {
  for (const char* word : {"infinity", "inf", "nan"}) {
    const std::size_t length = std::char_traits<char>::length(word);
    if (at + length <= text.size() && strncasecmp(text.c_str() + at, word, length) == 0) return length;
  }
  return 0;
}

/// Fortran writes "1.5D-03".
bool isExponentSign(char c) { return c == 'e' || c == 'E' || c == 'd' || c == 'D'; }

double valueOf(const std::string& text) {
  const std::size_t exponent = text.find_first_of("dD");
  if (exponent == std::string::npos) return strtod_l(text.c_str(), nullptr, pointLocale());
  return strtod_l(std::string(text).replace(exponent, 1, "e").c_str(), nullptr, pointLocale());
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
  if (std::isinf(value) && !is_word) throw FileError("'" + shownPiece(text) + "' is too large for a number");
  return value;
}

bool isMissingWord(const std::string& text) {
  if (text.size() > 8 || text.find_first_of("0123456789") != std::string::npos) return false;
  std::string word;
  for (const char c : text) word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* missing :
       {"na", "n/a", "#n/a", "#nv", "null", "none", "bad", "missing", "no data", "nodata", "void", "--", "---", "*"}) {
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

}  // namespace mems_stiction
