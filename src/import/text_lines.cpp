#include "import/text_lines.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "import/file_bytes.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kMostLines = kMaxPixels / 2;  ///< a grid has two columns
constexpr std::size_t kMostHeading = 1'000'000;     ///< with what is said between the numbers

void appendUtf8(std::string& text, std::uint32_t code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | code >> 6);
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    text += static_cast<char>(0xE0 | code >> 12);
    text += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  }
}

/// Characters beyond the basic plane are not in any number or unit: their halves pass as they are.
std::string fromUtf16(const std::string& bytes, bool is_big_endian) {
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    const auto first = static_cast<unsigned char>(bytes[at]);
    const auto second = static_cast<unsigned char>(bytes[at + 1]);
    const std::uint32_t code = is_big_endian ? first << 8 | second : second << 8 | first;
    if (code != 0xFEFF) appendUtf8(text, code);
  }
  return text;
}

std::string decoded(const std::string& bytes) {
  if (startsWith(bytes, "\xEF\xBB\xBF")) return bytes.substr(3);
  const bool is_wide = bytes.size() >= 4;
  if (startsWith(bytes, "\xFF\xFE") ||
      (is_wide && bytes[0] != 0 && bytes[1] == 0 && bytes[2] != 0 && bytes[3] == 0)) {
    return fromUtf16(bytes, false);
  }
  if (startsWith(bytes, "\xFE\xFF") ||
      (is_wide && bytes[0] == 0 && bytes[1] != 0 && bytes[2] == 0 && bytes[3] != 0)) {
    return fromUtf16(bytes, true);
  }
  return bytes;
}

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

/// The word that begins here, up to a separator.
std::string wordFrom(const std::string& text, std::size_t at, const char* separators) {
  return text.substr(at, std::min(text.find_first_of(separators, at), text.size()) - at);
}

/// Where the comment begins; the size of the text if there is none. "#N/A" of spreadsheets is a
/// cell.
std::size_t commentStart(const std::string& text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '#' && text[at] != '%') continue;
    if ((at == 0 || isBlank(text[at - 1])) && !isMissingWord(wordFrom(text, at, " \t\r,;")))
      return at;
  }
  return text.size();
}

/// Spaces alone: a tab at either end may stand for an empty cell.
std::string withoutBlanks(const std::string& text) {
  std::size_t begin = 0;
  std::size_t end = text.size();
  while (end > begin && isBlank(text[end - 1]) && text[end - 1] != '\t') --end;
  while (begin < end && isBlank(text[begin]) && text[begin] != '\t') ++begin;
  return text.substr(begin, end - begin);
}

bool isEmpty(const std::string& text) {
  return text.find_first_not_of(" \t\r\f\v") == std::string::npos;
}

/// A letter that does not begin "nan", "inf" or another word for no number.
bool isHeading(const std::string& text) {
  const std::size_t at = text.find_first_not_of(" \t\"'");
  if (at == std::string::npos) return false;
  const auto first = static_cast<unsigned char>(text[at]);
  if (first >= 0x80 || first == '[' || first == '(') return true;
  if (std::isalpha(first) == 0) return false;
  if (isMissingWord(wordFrom(text, at, " \t,;")) || isMissingWord(wordFrom(text, at, "\t,;")))
    return false;
  const std::string start = lowered(text.substr(at, 3));
  return start != "nan" && start != "inf";
}

/// "No Data" is one word, whatever separates the cells.
void joinNoData(std::string& text) {
  for (std::size_t at = text.find(' ', 2); at != std::string::npos; at = text.find(' ', at + 1)) {
    const bool may_be = text[at - 1] == 'o' || text[at - 1] == 'O';
    if (may_be && lowered(text.substr(at - 2, 7)) == "no data") text.erase(at, 1);
  }
}

/// Signs that may group thousands: seldom, so that nothing is copied for the lines without.
bool hasSignsBeyondNumbers(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    return c == '\'' || c == '_' || static_cast<unsigned char>(c) >= 0x80;
  });
}

}  // namespace

std::string lineName(const TextLine& line) { return "line " + std::to_string(line.number) + ": "; }

TextLines textLines(const std::string& bytes) {
  const std::string text = decoded(bytes);
  const char line_end = text.find('\n') == std::string::npos ? '\r' : '\n';
  TextLines lines;
  lines.ends_with_line_end = !text.empty() && text.back() == line_end;
  bool begins_block = true;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(line_end, at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    if (line.find('\0') != std::string::npos) {
      throw FileError("line " + std::to_string(number) +
                      ": binary data where numbers are expected: damaged, or a scan of another "
                      "format, which needs that "
                      "format's file name extension");
    }
    const std::size_t comment = commentStart(line);
    std::string content = withoutBlanks(line.substr(0, comment));
    plainNans(content);
    if (hasSignsBeyondNumbers(content)) {
      content = toUtf8(content);
      plainSigns(content);
    }
    if (isEmpty(content)) {
      begins_block = true;
      if (comment < line.size())
        lines.heading.push_back({number, toUtf8(withoutBlanks(line.substr(comment)))});
    } else if (lines.data.empty() && isHeading(content)) {
      lines.heading.push_back({number, toUtf8(content)});
    } else {
      if (begins_block) lines.blocks.push_back(lines.data.size());
      begins_block = false;
      joinNoData(content);
      lines.data.push_back({number, content});
    }
    if (lines.data.size() > kMostLines || lines.heading.size() > kMostHeading) {
      throw FileError("has more than " + std::to_string(kMostLines) + " lines of numbers or " +
                      std::to_string(kMostHeading) + " of heading: no scan");
    }
  }
  return lines;
}

}  // namespace mems_stiction
