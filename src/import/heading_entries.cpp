#include "import/heading_entries.hpp"

#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "import/text_style.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {

std::string bareText(const std::string& text) { return trimmed(text, " \t\r\"'"); }

std::string headingContent(const std::string& line) {
  std::string text = line.substr(std::min(line.find_first_not_of("#% \t"), line.size()));
  for (const char* blank : {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89"})
    text = replaced(text, blank, " ");
  return bareText(replaced(text, "\xEF\xBC\x9A", ":"));
}

bool splitEntry(const std::string& text, std::string& key, std::string& value) {
  const std::size_t at = text.find_first_of(":=");
  if (at == std::string::npos) return false;
  key = lowered(bareText(text.substr(0, at)));
  value = bareText(text.substr(at + 1));
  return true;
}

std::vector<std::string> cellsOf(const std::string& line, char separator) {
  std::vector<std::string> cells;
  for (const TextPiece& piece : piecesOf(line, separator))
    cells.push_back(bareText(unquoted(line, piece)));
  return cells;
}

std::size_t headingCount(const std::string& value) {
  const double number = plainNumber(value);
  return number >= 1.0 ? static_cast<std::size_t>(std::min(number, 1e12)) : 0;
}

double headingNumber(const std::string& value) {
  if (value.find(',') == std::string::npos) return plainNumber(value);
  if (markUse(value, ',') != MarkUse::kDecimal) {
    throw FileError("'" + shownPiece(value) +
                    "' has a mark that may be decimal or group thousands: write a point");
  }
  return plainNumber(withPlainMarks(value, ','));
}

void stateText(std::string& field, const std::string& value, const std::string& what) {
  const auto unit = heightUnit(value);
  if (!field.empty() && field != value && !(unit && heightUnit(field) == unit)) {
    throw FileError("the heading states the " + what + " twice, as '" + shownPiece(field) +
                    "' and '" + shownPiece(value) + "': remove one");
  }
  field = value;
}

}  // namespace mems_stiction
