#include "mems_stiction/import/number_marks.hpp"

#include <algorithm>
#include <cctype>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/plain_number.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kGroup = 3;  // digits
constexpr int kMostGroups = 10;    // after the first

bool isDigit(const std::string& text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
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

/// True if the mark at `at` stands between groups of thousands: up to three digits before the first, three after each.
/// - @p not_before what cannot stand before the first group: there it would end the decimals of another number
bool groupsAt(const std::string& text, std::size_t at, const std::string& mark, const char* not_before) {
  for (int groups = 0; groups < kMostGroups; ++groups) {
    if (digitsFrom(text, at + mark.size(), kGroup + 1) != kGroup) return false;
    const std::size_t head = digitsBefore(text, at, kGroup + 1);
    const std::size_t begin = at - head;
    if (head != kGroup || begin < mark.size() || text.compare(begin - mark.size(), mark.size(), mark) != 0) {
      const bool is_after_decimals = begin > 0 && std::string(not_before).find(text[begin - 1]) != std::string::npos;
      return head > 0 && head <= kGroup && text[begin] != '0' && !is_after_decimals;
    }
    at = begin - mark.size();
  }
  return false;
}

}  // namespace

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
  const std::string minus = "\xE2\x88\x92";
  for (std::size_t at = text.find(minus); at != std::string::npos; at = text.find(minus, at)) {
    text.replace(at, minus.size(), "-");
  }
  struct Mark {
    const char* sign;
    const char* not_before;
  };
  // Blanks also stand between cells, where decimals of either kind may end.
  for (const Mark& mark : {Mark{"'", "."}, Mark{"_", "."}, Mark{"\xE2\x80\x99", "."}, Mark{"\xC2\xA0", ".,"},
                           Mark{"\xE2\x80\xAF", ".,"}, Mark{"\xE2\x80\x89", ".,"}, Mark{"\xE2\x80\x87", ".,"}}) {
    const std::string sign = mark.sign;
    if (text.find(sign) == std::string::npos) continue;
    std::string kept;
    std::size_t from = 0;
    for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign, at + sign.size())) {
      if (!groupsAt(text, at, sign, mark.not_before)) continue;
      kept += text.substr(from, at - from);
      from = at + sign.size();
    }
    text = kept + text.substr(from);
  }
}

bool isGroupBlank(const std::string& text, std::size_t at) { return groupsAt(text, at, " ", ".,"); }

std::string ambiguousMark(const std::string& number) {
  return "'" + shownPiece(number) +
         "' has a mark that may be decimal or group thousands: state decimal_mark: point or comma in the sidecar "
         "(SCAN.yaml), or as scan/decimal_mark";
}

}  // namespace mems_stiction
