#include "import/text_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

/// Digits of a number, by which one that was cut off can be told from the others.
struct NumberShape {
  std::size_t length = 0, decimals = 0, exponent = 0;
};

NumberShape shapeOf(const std::string& number) {
  NumberShape shape;
  shape.length = number.size();
  const std::size_t exponent = std::min(number.find_first_of("eEdD"), number.size());
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
    if (style_.separator == ' ') checkTabs(line);
    const bool has_end = style_.has_end && style_.separator != ' ';
    std::size_t column = 0;
    std::optional<TextPiece> last;  // behind the separator that ends a line is no cell
    const auto take = [&](const TextPiece& piece) {
      ++column;
      try {
        cells_.values.push_back(value(unquoted(line.text, piece)));
      } catch (const FileError& error) {
        throw FileError(lineName(line) + error.what() + ", column " + std::to_string(column));
      }
    };
    forEachPiece(line.text, style_.separator, [&](const TextPiece& piece) {
      if (last) take(*last);
      last = piece;
      return true;
    });
    if (!has_end) {
      take(*last);
    } else if (last->begin != last->end) {
      throw FileError(lineName(line) + "a quotation mark without its partner");
    }
    return column;
  }

  TextCells finish(std::size_t cols, std::size_t rows) {
    cells_.cols = cols;
    cells_.rows = rows;
    cells_.is_last_shorter =
        has_previous_ && (last_.length < least_.length || last_.decimals < least_.decimals ||
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
        throw FileError(lineName(line) + "an empty cell between tabs, column " +
                        std::to_string(column + (is_open ? 0 : 1)) +
                        ": write nan for missing values");
      }
      is_open = true;
      ++column;
    }
  }

  double value(std::string text) {
    if (text.empty() || isMissingWord(text)) return std::numeric_limits<double>::quiet_NaN();
    if (text.find_first_of(style_.decimal == ',' ? ",. " : ", ") != std::string::npos) {
      text = withPlainMarks(text, style_.decimal);
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
  NumberShape least_{std::string::npos, std::string::npos,
                     std::string::npos};  ///< of those before the last
  bool has_last_ = false, has_previous_ = false;
};

}  // namespace

TextCells textCells(const std::vector<TextLine>& lines, const TextStyle& style) {
  CellReader reader(style);
  std::size_t cols = 0;
  for (const TextLine& line : lines) {
    const std::size_t count = reader.read(line);
    if (&line != &lines.front() && count != cols) {
      throw FileError(lineName(line) + std::to_string(count) + " cells, the lines before it have " +
                      std::to_string(cols) + ": the file is cut off, or not a grid; column " +
                      std::to_string(std::min(count, cols) + 1));
    }
    cols = count;
  }
  return reader.finish(cols, lines.size());
}

}  // namespace mems_stiction
