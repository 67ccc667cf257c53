#include "mems_stiction/import/text_cells.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/plain_number.hpp"

namespace mems_stiction {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isQuote(char c) { return c == '"' || c == '\''; }

std::string at(const TextLine& line) { return "line " + std::to_string(line.number) + ": "; }

/// A piece of a line between separators.
struct Piece {
  std::size_t begin = 0, end = 0;
};

/// Pieces between separators outside quotes, without the blanks around them. For blanks as separator none is empty.
std::vector<Piece> piecesOf(const std::string& text, char separator) {
  std::vector<Piece> pieces;
  Piece piece;
  char quote = '\0';
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const bool is_end = i == text.size();
    if (!is_end && isQuote(text[i]) && (quote == '\0' || quote == text[i])) quote = quote == '\0' ? text[i] : '\0';
    const bool separates = !is_end && quote == '\0' && (separator == ' ' ? isBlank(text[i]) : text[i] == separator);
    if (!is_end && !separates) continue;
    piece.end = i;
    while (piece.begin < piece.end && isBlank(text[piece.begin])) ++piece.begin;
    while (piece.end > piece.begin && isBlank(text[piece.end - 1])) --piece.end;
    if (separator != ' ' || piece.end > piece.begin) pieces.push_back(piece);
    piece.begin = i + 1;
  }
  return pieces;
}

std::string unquoted(const std::string& text, const Piece& piece) {
  std::size_t begin = piece.begin;
  std::size_t end = piece.end;
  if (end - begin >= 2 && isQuote(text[begin]) && text[end - 1] == text[begin]) {
    ++begin;
    --end;
  }
  return text.substr(begin, end - begin);
}

/// What stands between the numbers of a file, gathered over all lines.
struct Signs {
  bool semicolon = false, comma = false, point = false, quoted_comma = false;
  const TextLine* tight_comma = nullptr;  ///< between two digits
  const TextLine* loose_comma = nullptr;  ///< with a blank beside it
  const TextLine* bare_gap = nullptr;     ///< blanks between two numbers, without another separator
};

void gather(const TextLine& line, Signs& signs) {
  const std::string& text = line.text;
  const auto is_digit = [&text](std::size_t i) { return std::isdigit(static_cast<unsigned char>(text[i])) != 0; };
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (isQuote(c)) is_quoted = !is_quoted;
    if (c == '.') signs.point = true;
    if (c == ';') signs.semicolon = true;
    if (c == ',' && is_quoted) signs.quoted_comma = true;
    if (c == ',' && !is_quoted) {
      signs.comma = true;
      if (i == 0 || i + 1 == text.size()) continue;
      if (is_digit(i - 1) && is_digit(i + 1)) {
        signs.tight_comma = &line;
      } else if (isBlank(text[i - 1]) || isBlank(text[i + 1])) {
        signs.loose_comma = &line;
      }
    }
    if (isBlank(c)) {
      const std::size_t next = text.find_first_not_of(" \t", i);
      const bool is_inside = i > 0 && next != std::string::npos;
      if (is_inside && text[i - 1] != ',' && text[i - 1] != ';' && text[next] != ',' && text[next] != ';') {
        signs.bare_gap = &line;
      }
      i = std::min(next, text.size()) - 1;
    }
  }
}

/// Cells between commas that look like the two halves of numbers with decimal commas: "0,437,1,041".
bool looksHalved(const std::vector<TextLine>& lines) {
  std::size_t digits = 0;  // of every second cell, as long as all are the same
  bool is_first_different = false;
  bool are_seconds_alike = true;
  for (const TextLine& line : lines) {
    const std::vector<Piece> pieces = piecesOf(line.text, ',');
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      std::string cell = unquoted(line.text, pieces[i]);
      cell.erase(std::min(cell.find_first_of("eE"), cell.size()));
      const bool is_unsigned = !cell.empty() && cell.find_first_not_of("0123456789") == std::string::npos;
      if (is_unsigned && cell.size() > 1 && cell[0] == '0') return true;
      if (i % 2 == 0) {
        if (cell.size() != digits) is_first_different = true;
        continue;
      }
      if (digits == 0 && is_unsigned) {
        digits = cell.size();
        is_first_different = unquoted(line.text, pieces[0]).size() != digits;
      }
      if (!is_unsigned || cell.size() != digits) are_seconds_alike = false;
    }
    if (pieces.size() % 2 == 1) are_seconds_alike = false;
  }
  return are_seconds_alike && is_first_different && digits > 1;
}

/// Digits of a number, by which one that was cut off can be told from the others.
struct NumberShape {
  std::size_t length = 0, decimals = 0, exponent = 0;
};

NumberShape shapeOf(const std::string& number) {
  NumberShape shape;
  shape.length = number.size();
  const std::size_t exponent = std::min(number.find_first_of("eE"), number.size());
  const std::size_t point = std::min(number.find('.'), exponent);
  shape.decimals = exponent - std::min(point + 1, exponent);
  shape.exponent = number.size() - exponent;
  return shape;
}

class CellReader {
 public:
  explicit CellReader(const TextStyle& style) : style_(style) {}

  /// Appends the cells of the line. @return how many
  std::size_t read(const TextLine& line) {
    std::vector<Piece> pieces = piecesOf(line.text, style_.separator);
    if (style_.has_end && style_.separator != ' ') {
      if (pieces.back().begin != pieces.back().end) throw FileError(at(line) + "a quotation mark without its partner");
      pieces.pop_back();
    }
    if (style_.separator == ' ') checkTabs(line);
    std::size_t column = 0;
    for (const Piece& piece : pieces) {
      ++column;
      try {
        cells_.values.push_back(value(unquoted(line.text, piece)));
      } catch (const FileError& error) {
        throw FileError(at(line) + error.what() + ", column " + std::to_string(column));
      }
    }
    return pieces.size();
  }

  TextCells finish(std::size_t cols, std::size_t rows) {
    cells_.cols = cols;
    cells_.rows = rows;
    cells_.is_last_shorter = has_previous_ && (last_.length < least_.length || last_.decimals < least_.decimals ||
                                               last_.exponent < least_.exponent);
    return std::move(cells_);
  }

 private:
  /// A cell between two tabs is perhaps missing, perhaps only an alignment.
  void checkTabs(const TextLine& line) const {
    const std::string& text = line.text;
    std::size_t column = 1;
    bool is_open = true;  // no number since the last tab
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '\t') {
        if (text[i] != ' ') is_open = false;
        continue;
      }
      const bool is_last = text.find_first_not_of(" \t", i) == std::string::npos;
      if (is_last && style_.has_end && !is_open) return;
      if (is_open || is_last) {
        throw FileError(at(line) + "an empty cell between tabs, column " + std::to_string(column + (is_open ? 0 : 1)) +
                        ": write nan for missing values");
      }
      is_open = true;
      ++column;
    }
  }

  double value(std::string text) {
    if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
    if (style_.decimal == ',') {
      const std::size_t comma = text.find(',');
      if (comma != std::string::npos) text[comma] = '.';
    }
    const double number = plainNumber(text);
    if (has_last_) {
      least_.length = std::min(least_.length, last_.length);
      least_.decimals = std::min(least_.decimals, last_.decimals);
      least_.exponent = std::min(least_.exponent, last_.exponent);
      has_previous_ = true;
    }
    if (std::isfinite(number)) {
      last_ = shapeOf(text);
      has_last_ = true;
    }
    return std::isfinite(number) ? number : std::numeric_limits<double>::quiet_NaN();
  }

  TextStyle style_;
  TextCells cells_;
  NumberShape last_;
  NumberShape least_{std::string::npos, std::string::npos, std::string::npos};  ///< of those before the last
  bool has_last_ = false, has_previous_ = false;
};

}  // namespace

TextStyle textStyle(const std::vector<TextLine>& lines) {
  Signs signs;
  for (const TextLine& line : lines) gather(line, signs);
  const std::string advice = "write a point as decimal sign";
  TextStyle style;
  if (signs.semicolon) {
    style.separator = ';';
    if (signs.comma || signs.quoted_comma) style.decimal = ',';
  } else if (signs.tight_comma != nullptr && signs.bare_gap != nullptr) {
    if (signs.loose_comma != nullptr) {
      throw FileError(at(*signs.loose_comma) + "commas and blanks both stand between the numbers: " + advice);
    }
    style.decimal = ',';
  } else if (signs.comma) {
    style.separator = ',';
    if (signs.quoted_comma) style.decimal = ',';
    if (!signs.point && !signs.quoted_comma &&
        ((signs.tight_comma != nullptr && signs.loose_comma != nullptr) || looksHalved(lines))) {
      throw FileError(at(lines.front()) +
                      "the commas separate numbers, or they are decimal commas; both readings are possible: " + advice +
                      ", or separate by semicolons");
    }
  } else if (signs.quoted_comma) {
    style.decimal = ',';
  }
  if (style.decimal == ',' && signs.point) {
    throw FileError(at(lines.front()) + "points and decimal commas both stand inside numbers: " + advice);
  }
  style.has_end = std::all_of(lines.begin(), lines.end(), [&style](const TextLine& line) {
    return line.text.back() == (style.separator == ' ' ? '\t' : style.separator);
  });
  return style;
}

TextCells textCells(const std::vector<TextLine>& lines, const TextStyle& style) {
  CellReader reader(style);
  std::size_t cols = 0;
  for (const TextLine& line : lines) {
    const std::size_t count = reader.read(line);
    if (&line != &lines.front() && count != cols) {
      throw FileError(at(line) + std::to_string(count) + " cells, the lines before it have " + std::to_string(cols) +
                      ": the file is cut off, or not a grid; column " + std::to_string(std::min(count, cols) + 1));
    }
    cols = count;
  }
  return reader.finish(cols, lines.size());
}

}  // namespace mems_stiction
