#include "import/text_style.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <utility>

#include "import/file_bytes.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

bool isSpaceOrTab(char c) { return c == ' ' || c == '\t'; }
bool isQuote(char c) { return c == '"' || c == '\''; }

const std::string kBlankAdvice =
    "the blanks separate numbers, or they group thousands: write numbers without groups, or "
    "separate by semicolons";

/// What stands between the numbers of a file, gathered over all lines.
struct Signs {
  bool semicolon = false, comma = false, point = false, quoted_comma = false;
  const TextLine* tight_comma = nullptr;  ///< between two digits
  const TextLine* loose_comma = nullptr;  ///< with a blank beside it
  const TextLine* bare_gap = nullptr;     ///< blanks between two numbers, without another separator
  std::uint64_t semicolons = 0, commas = 0, gaps = 0;  ///< how many, but quoted commas
};

void gather(const TextLine& line, Signs& signs) {
  const std::string& text = line.text;
  const auto is_digit = [&text](std::size_t i) {
    return std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (isQuote(c)) is_quoted = !is_quoted;
    if (c == '.') signs.point = true;
    if (c == ';') {
      signs.semicolon = true;
      ++signs.semicolons;
    }
    if (c == ',' && is_quoted) signs.quoted_comma = true;
    if (c == ',' && !is_quoted) {
      signs.comma = true;
      ++signs.commas;
      if (i == 0 || i + 1 == text.size()) continue;
      if (is_digit(i - 1) && is_digit(i + 1)) {
        signs.tight_comma = &line;
      } else if (isSpaceOrTab(text[i - 1]) || isSpaceOrTab(text[i + 1])) {
        signs.loose_comma = &line;
      }
    }
    if (isSpaceOrTab(c)) {
      const std::size_t next = text.find_first_not_of(" \t", i);
      const bool is_inside = i > 0 && next != std::string::npos;
      if (is_inside && text[i - 1] != ',' && text[i - 1] != ';' && text[next] != ',' &&
          text[next] != ';') {
        signs.bare_gap = &line;
        ++signs.gaps;
      }
      i = std::min(next, text.size()) - 1;
    }
  }
}

/// Cells between commas that look like the two halves of numbers with decimal commas:
/// "0,437,1,041".
bool looksHalved(const std::vector<TextLine>& lines) {
  std::size_t digits = 0;  // of every second cell, as long as all are the same
  bool is_first_different = false;
  bool are_seconds_alike = true;
  for (const TextLine& line : lines) {
    std::size_t count = 0;
    std::size_t first_size = 0;
    bool begins_with_zero = false;
    forEachPiece(line.text, ',', [&](const TextPiece& piece) {
      std::string cell = unquoted(line.text, piece);
      if (count == 0) first_size = cell.size();
      cell.erase(std::min(cell.find_first_of("eE"), cell.size()));
      const bool is_unsigned =
          !cell.empty() && cell.find_first_not_of("0123456789") == std::string::npos;
      begins_with_zero = is_unsigned && cell.size() > 1 && cell[0] == '0';
      if (begins_with_zero) return false;
      if (count++ % 2 == 0) {
        if (cell.size() != digits) is_first_different = true;
        return true;
      }
      if (digits == 0 && is_unsigned) {
        digits = cell.size();
        is_first_different = first_size != digits;
      }
      if (!is_unsigned || cell.size() != digits) are_seconds_alike = false;
      return true;
    });
    if (begins_with_zero) return true;
    if (count % 2 == 1) are_seconds_alike = false;
  }
  return are_seconds_alike && is_first_different && digits > 1;
}

/// Up to three digits with a sign, not 0 first: what groups of thousands may follow.
bool startsThousands(std::string cell) {
  if (!cell.empty() && (cell[0] == '-' || cell[0] == '+')) cell.erase(0, 1);
  return !cell.empty() && cell.size() <= 3 && cell[0] != '0' &&
         cell.find_first_not_of("0123456789") == std::string::npos;
}

/// The numbers of a line, and how many they are if all groups of three digits are joined to what
/// they may belong to.
std::pair<std::size_t, std::size_t> countsOf(const std::string& text, char separator) {
  const std::string marks = separator == ',' ? "." : ".,";
  std::size_t pieces = 0;
  std::size_t count = 0;
  std::size_t last_end = 0;
  bool is_open = false;  // the last number may go on
  forEachPiece(text, separator, [&](const TextPiece& piece) {
    ++pieces;
    const std::string cell = text.substr(piece.begin, piece.end - piece.begin);
    const bool is_near = separator != ' ' || (piece.begin == last_end + 1 && text[last_end] == ' ');
    const std::size_t digits = std::min(cell.find_first_not_of("0123456789"), cell.size());
    const bool is_whole = digits == cell.size();
    if (is_open && is_near && digits == 3 &&
        (is_whole || marks.find(cell[digits]) != std::string::npos)) {
      is_open = is_whole;
    } else {
      ++count;
      is_open = startsThousands(cell);
    }
    last_end = piece.end;
    return true;
  });
  return {pieces, count};
}

/// Every line has the same number of cells, 2 or more, if its groups of three digits are joined:
/// "1,500,-2,250".
bool looksGrouped(const std::vector<TextLine>& lines, char separator) {
  std::size_t cols = 0;
  for (const TextLine& line : lines) {
    const auto [pieces, joined] = countsOf(line.text, separator);
    if (joined == pieces || (cols != 0 && joined != cols)) return false;
    cols = joined;
  }
  return cols > 1;
}

/// @throw FileError for more of what separates cells than a scan has pixels
void checkCellCount(std::uint64_t separators) {
  if (separators <= kMaxPixels) return;
  throw FileError("its lines have more than the " + std::to_string(kMaxPixels) +
                  " numbers that a scan may have");
}

char other(char mark) { return mark == ',' ? '.' : ','; }

/// The sign before the decimals where the file alone decides.
char decimalOf(const std::vector<TextLine>& lines, char mark, char hint, TextStyle& style) {
  const TextLine* line_of_either = nullptr;
  std::string either;
  bool has_groups = false;
  bool is_decimal = false;
  for (const TextLine& line : lines) {
    forEachPiece(line.text, style.separator, [&](const TextPiece& piece) {
      const std::string number = unquoted(line.text, piece);
      const MarkUse use = markUse(number, mark);
      is_decimal = use == MarkUse::kDecimal;
      if (use == MarkUse::kGroups) has_groups = true;
      if (use == MarkUse::kEither && line_of_either == nullptr) {
        line_of_either = &line;
        either = number;
      }
      return !is_decimal;
    });
    if (is_decimal) return mark;
  }
  if (has_groups) return other(mark);
  if (line_of_either == nullptr) return mark;
  if (hint != '\0') return hint;
  if (mark == ',' || style.separator == ';')
    throw FileError(lineName(*line_of_either) + ambiguousMark(either));
  style.guess = either;
  return mark;
}

/// Tabs or semicolons: other blanks inside cells group thousands, or part numbers too.
void joinInCells(std::vector<TextLine>& lines, bool is_sure) {
  bool has_groups = false;
  const TextLine* whole = nullptr;
  for (const TextLine& line : lines) {
    const std::string& text = line.text;
    for (std::size_t i = text.find(' '); i != std::string::npos; i = text.find(' ', i + 1)) {
      const std::string separators = " \t;,";
      const bool is_inside = i > 0 && i + 1 < text.size() &&
                             separators.find(text[i - 1]) == std::string::npos &&
                             separators.find(text[i + 1]) == std::string::npos;
      if (!is_inside) continue;
      if (!isGroupBlank(text, i)) return;
      has_groups = true;
      const bool has_decimals =
          i + 4 < text.size() && (text[i + 4] == '.' || text[i + 4] == ',' || text[i + 4] == ' ');
      if (!has_decimals) whole = &line;
    }
  }
  if (!has_groups) return;
  if (whole != nullptr && !is_sure) throw FileError(lineName(*whole) + kBlankAdvice);
  for (TextLine& line : lines) {
    std::string joined;
    for (std::size_t i = 0; i < line.text.size(); ++i) {
      if (line.text[i] != ' ' || !isGroupBlank(line.text, i)) joined += line.text[i];
    }
    line.text = joined;
  }
}

}  // namespace

void forEachPiece(const std::string& text, char separator,
                  const std::function<bool(const TextPiece&)>& take) {
  TextPiece piece;
  char quote = '\0';
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const bool is_end = i == text.size();
    if (!is_end && isQuote(text[i]) && (quote == '\0' || quote == text[i]))
      quote = quote == '\0' ? text[i] : '\0';
    const bool separates = !is_end && quote == '\0' &&
                           (separator == ' ' ? isSpaceOrTab(text[i]) : text[i] == separator);
    if (!is_end && !separates) continue;
    piece.end = i;
    while (piece.begin < piece.end && isSpaceOrTab(text[piece.begin])) ++piece.begin;
    while (piece.end > piece.begin && isSpaceOrTab(text[piece.end - 1])) --piece.end;
    if ((separator != ' ' || piece.end > piece.begin) && !take(piece)) return;
    piece.begin = i + 1;
  }
}

std::vector<TextPiece> piecesOf(const std::string& text, char separator) {
  std::vector<TextPiece> pieces;
  forEachPiece(text, separator, [&pieces](const TextPiece& piece) {
    pieces.push_back(piece);
    return true;
  });
  return pieces;
}

std::string unquoted(const std::string& text, const TextPiece& piece) {
  std::size_t begin = piece.begin;
  std::size_t end = piece.end;
  if (end - begin >= 2 && isQuote(text[begin]) && text[end - 1] == text[begin]) {
    ++begin;
    --end;
  }
  return text.substr(begin, end - begin);
}

void joinThousands(std::vector<TextLine>& lines) {
  const auto all_have = [&lines](char sign) {
    return std::all_of(lines.begin(), lines.end(), [sign](const TextLine& line) {
      return line.text.find(sign) != std::string::npos;
    });
  };
  if (all_have(';')) {
    joinInCells(lines, true);
  } else if (all_have('\t')) {
    joinInCells(lines, false);
  } else if (looksGrouped(lines, ' ')) {
    throw FileError(lineName(lines.front()) + kBlankAdvice);
  }
}

TextStyle textStyle(const std::vector<TextLine>& lines, char stated, char hint) {
  Signs signs;
  for (const TextLine& line : lines) gather(line, signs);
  const std::string advice = "write a point as decimal sign";
  TextStyle style;
  if (signs.semicolon) {
    style.separator = ';';
    checkCellCount(signs.semicolons);
  } else if (signs.tight_comma != nullptr && signs.bare_gap != nullptr) {
    if (signs.loose_comma != nullptr) {
      throw FileError(lineName(*signs.loose_comma) +
                      "commas and blanks both stand between the numbers: " + advice);
    }
  } else if (signs.comma) {
    style.separator = ',';
    checkCellCount(signs.commas);
    const bool is_halved =
        !signs.point &&
        ((signs.tight_comma != nullptr && signs.loose_comma != nullptr) || looksHalved(lines));
    if (!signs.quoted_comma &&
        (stated == ',' || (stated == '\0' && (is_halved || looksGrouped(lines, ','))))) {
      throw FileError(
          lineName(lines.front()) +
          "the commas separate numbers, or they are decimal commas or group thousands: " + advice +
          " and no other, or separate by semicolons; decimal_mark: point in the sidecar "
          "(SCAN.yaml) says "
          "that they separate");
    }
  }
  if (style.separator == ' ') checkCellCount(signs.gaps);
  const bool has_comma = signs.quoted_comma || (signs.comma && style.separator != ',');
  if (stated != '\0') {
    style.decimal = stated;
  } else if (has_comma && signs.point) {
    throw FileError(lineName(lines.front()) +
                    "points and decimal commas both stand inside numbers: " + advice +
                    " and no other, or state decimal_mark in the sidecar (SCAN.yaml)");
  } else if (has_comma || (signs.point && style.separator != ',')) {
    style.decimal = decimalOf(lines, has_comma ? ',' : '.', hint, style);
  }
  style.has_end = std::all_of(lines.begin(), lines.end(), [&style](const TextLine& line) {
    return line.text.back() == (style.separator == ' ' ? '\t' : style.separator);
  });
  return style;
}

}  // namespace mems_stiction
