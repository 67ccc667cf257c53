#include "import/length_unit.hpp"

#include <cstring>
#include <map>

#include "import/plain_number.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

std::string withoutBrackets(const std::string& text) { return trimmed(text, " \t\r\n[]()\"'"); }

bool isUtf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto lead = static_cast<unsigned char>(text[at]);
    std::size_t more = 0;
    if (lead >= 0x80) {
      if (lead < 0xC2 || lead > 0xF4) return false;
      more = lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
    }
    if (at + more >= text.size() && more > 0) return false;
    for (std::size_t i = 1; i <= more; ++i) {
      if ((static_cast<unsigned char>(text[at + i]) & 0xC0) != 0x80) return false;
    }
    at += more + 1;
  }
  return true;
}

/// How the word for a unit begins in several languages: the endings are those of number and case.
constexpr struct {
  const char* stem;
  double unit;
} kSpelled[] = {
    {"nanomet", 1e-9},      {"nanomèt", 1e-9},   {"nanómet", 1e-9},  {"nanômet", 1e-9},
    {"нанометр", 1e-9},     {"纳米", 1e-9},      {"奈米", 1e-9},     {"ナノメートル", 1e-9},
    {"나노미터", 1e-9},     {"micromet", 1e-6},  {"micromèt", 1e-6}, {"micrómet", 1e-6},
    {"micrômet", 1e-6},     {"mikromet", 1e-6},  {"micron", 1e-6},   {"mikron", 1e-6},
    {"микрометр", 1e-6},    {"микрон", 1e-6},    {"微米", 1e-6},     {"マイクロメートル", 1e-6},
    {"마이크로미터", 1e-6}, {"millimet", 1e-3},  {"millimèt", 1e-3}, {"milimet", 1e-3},
    {"milímet", 1e-3},      {"миллиметр", 1e-3}, {"毫米", 1e-3},     {"ミリメートル", 1e-3},
    {"밀리미터", 1e-3},     {"angstr", 1e-10},   {"ångstr", 1e-10},  {"Ångstr", 1e-10},
    {"ангстрем", 1e-10}};

std::optional<double> spelledUnit(const std::string& text) {
  constexpr std::size_t kLongestEnding = 6;  // [bytes]
  const std::string word = lowered(text);
  for (const auto& [stem, unit] : kSpelled) {
    const std::size_t length = std::strlen(stem);
    if (!startsWith(word, stem) || word.size() > length + kLongestEnding) continue;
    if (word.find_first_of("-_0123456789", length) == std::string::npos) return unit;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> lengthUnit(const std::string& text) {
  std::string unit = withoutBrackets(text);
  for (const char* micro : {"\xC2\xB5", "\xCE\xBC", "\\u00B5", "\\u00b5", "&#181;", "&micro;"}) {
    unit = replaced(unit, micro, "u");
  }
  for (const char* angstrom : {"\xC3\x85", "\xE2\x84\xAB"}) unit = replaced(unit, angstrom, "A");
  unit = replaced(replaced(unit, "мк", "u"), "м", "m");  // as programs in Russian write them
  unit = replaced(unit, "н", "n");
  static const std::map<std::string, double> kUnits = {
      {"m", 1.0},      {"meter", 1.0}, {"meters", 1.0}, {"metre", 1.0},
      {"metres", 1.0}, {"cm", 1e-2},   {"mm", 1e-3},    {"um", 1e-6},
      {"nm", 1e-9},    {"pm", 1e-12},  {"fm", 1e-15},   {"A", 1e-10},
      {"AA", 1e-10},   {"Ang", 1e-10}, {"ang", 1e-10},  {"inch", 0.0254}};
  const auto found = kUnits.find(unit);
  if (found == kUnits.end()) return spelledUnit(withoutBrackets(text));
  return found->second;
}

std::optional<double> heightUnit(const std::string& text) {
  return withoutBrackets(text) == "A" ? std::nullopt : lengthUnit(text);
}

std::optional<StatedLength> statedLength(const std::string& text) {
  const std::string plain = withoutBrackets(text);
  const std::size_t end = numberEnd(plain, 0);
  if (end == 0) return std::nullopt;
  return StatedLength{plainNumber(plain.substr(0, end)), withoutBrackets(plain.substr(end))};
}

std::string toUtf8(const std::string& text) {
  if (isUtf8(text)) return text;
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    auto byte = static_cast<unsigned char>(text[at]);
    if (byte == 0xE6 && at + 1 < text.size() && text[at + 1] == 'm') byte = 0xB5;
    if (byte < 0x80) {
      result += static_cast<char>(byte);
    } else {
      result += static_cast<char>(0xC0 | byte >> 6);
      result += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return result;
}

}  // namespace mems_stiction
