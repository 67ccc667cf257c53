#include "import/heading_remarks.hpp"

#include <set>

#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

/// A unit of length that a remark mentions: somebody meant it to be read.
struct Mention {
  std::string unit;
  bool is_of_number = false;  ///< "2 um" is a side, "um" the unit of the numbers
};

Mention unitMentioned(const std::string& text) {
  Mention mention;
  std::string before;
  std::string word;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    if (at < text.size() && std::string(" \t,;:=()[]/").find(text[at]) == std::string::npos) {
      word += text[at];
      continue;
    }
    if (word.empty()) continue;
    const bool is_counted = std::string("+-.0123456789").find(word[0]) != std::string::npos;
    const std::size_t number =
        is_counted ? numberEnd(word, 0) : 0;  // "2um" is one word; "nan" begins one of its own
    const std::string unit = word.substr(number);
    if (unit.size() > 1 && unit != "inch" && lengthUnit(unit)) {
      const bool is_behind_number = !before.empty() && numberEnd(before, 0) == before.size();
      return {unit, number > 0 || is_behind_number};
    }
    before = word;
    word.clear();
  }
  return mention;
}

}  // namespace

bool isOtherUnit(const std::string& text) {
  const std::string unit = trimmed(text, " \t[]()");
  static const std::set<std::string> kWords = {"ampere",  "amperes", "amp",    "amps",
                                               "volt",    "volts",   "degree", "degrees",
                                               "radians", "hertz",   "a.u."};
  if (kWords.count(lowered(unit)) > 0) return true;
  static const std::set<std::string> kUnits = {
      "A", "V", "Hz", "deg", "\xC2\xB0", "rad", "N", "N/m", "Pa", "J",   "eV",  "W",
      "F", "s", "K",  "C",   "S",        "T",   "g", "Ohm", "%",  "V/m", "A/V", "J/m^2"};
  if (kUnits.count(unit) > 0) return true;
  for (const char* prefix : {"f", "p", "n", "u", "\xC2\xB5", "\xCE\xBC", "m", "k", "M", "G"}) {
    if (startsWith(unit, prefix) && kUnits.count(unit.substr(std::string(prefix).size())) > 0)
      return true;
  }
  return false;
}

void HeadingRemarks::read(const std::string& where, const std::string& text,
                          const std::string& value) {
  const Mention mention = unitMentioned(text);
  if (doubt.empty() && isOtherUnit(value)) {
    doubt = where + "'" + shownPiece(text) +
            "' states a unit and is not understood: if it is that of the numbers, they are no "
            "heights; else remove the "
            "line, or state \"# Value units: nm\"";
  } else if (doubt.empty() && !mention.unit.empty() && !mention.is_of_number) {
    doubt = where + "'" + shownPiece(mention.unit) +
            "' is not understood there; \"# Value units: " + mention.unit + "\" would be";
  } else if (side.empty() && mention.is_of_number) {
    side = where + "'" + shownPiece(mention.unit) + "' is not understood there; \"# Width: 2 " +
           mention.unit + "\" and \"# Height: 2 " + mention.unit + "\", or \"# Pixel size: 2 " +
           mention.unit + "\" would be";
  }
}

}  // namespace mems_stiction
