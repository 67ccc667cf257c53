#include "import/heading_words.hpp"

#include <map>

#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

/// Gwyddion writes its headings by its translation: these are its words "Channel:", "Width:",
/// "Height:", "Value units:" and "Lateral units:" in each of its languages (its translations of
/// 2016 and 2.62), and "XYZ data:" over lists of points. What it has not translated it writes in
/// English.
struct Language {
  const char* title;
  const char* width;
  const char* height;
  const char* unit_z;
  const char* unit_xy;
  const char* points;
};

constexpr Language kLanguages[] = {
    {"Channel", "Width", "Height", "Value units", "Lateral units", "XYZ data"},
    {"Kanál", "Šířka", "Výška", "Jednotky hodnot", "Jednotky rozměrů", "XYZ data"},
    {"Kanal", "Breite", "Höhe", "Einheiten", nullptr, "XYZ-Daten"},
    {"Canal", "Anchura", "Altura", nullptr, nullptr, nullptr},
    {"Canal", "Largeur", "Hauteur", "Unités", "Unités latérales", "Données XYZ"},
    {"Canale", "Larghezza", "Altezza", "unità valore", "Unità laterali", "File dati XYZ"},
    {"チャネル", "幅", "高さ", "値の単位", "水平単位", "XYZ データ"},
    {"채널", "폭", "높이", "값 단위", nullptr, nullptr},
    {"Canal", "Largura", "Altura", "Unidades de valor", "Unidades de laterais", "Dados XYZ"},
    {"Канал", "Ширина", "Высота", "Единицы измерения", "Единицы горизонтальных размеров",
     "Данные XYZ"},
};

/// What other programs write.
constexpr struct {
  const char* word;
  HeadingWord meaning;
} kOthers[] = {
    {"x-length", HeadingWord::kWidth},     {"x amplitude", HeadingWord::kWidth},
    {"y-length", HeadingWord::kHeight},    {"y amplitude", HeadingWord::kHeight},
    {"value unit", HeadingWord::kUnitZ},   {"data unit", HeadingWord::kUnitZ},
    {"z-unit", HeadingWord::kUnitZ},       {"zunit", HeadingWord::kUnitZ},
    {"unit data", HeadingWord::kUnitZ},    {"unités de valeur", HeadingWord::kUnitZ},
    {"z unit", HeadingWord::kUnitZ},       {"z units", HeadingWord::kUnitZ},
    {"z-units", HeadingWord::kUnitZ},      {"height unit", HeadingWord::kUnitZ},
    {"height units", HeadingWord::kUnitZ},
};

std::map<std::string, HeadingWord> allWords() {
  std::map<std::string, HeadingWord> words;
  const auto add = [&words](const char* word, HeadingWord meaning) {
    if (word != nullptr) words[lowered(word)] = meaning;
  };
  for (const Language& language : kLanguages) {
    add(language.title, HeadingWord::kTitle);
    add(language.points, HeadingWord::kTitle);
    add(language.width, HeadingWord::kWidth);
    add(language.height, HeadingWord::kHeight);
    add(language.unit_z, HeadingWord::kUnitZ);
    add(language.unit_xy, HeadingWord::kUnitXy);
  }
  for (const auto& other : kOthers) add(other.word, other.meaning);
  return words;
}

}  // namespace

HeadingWord headingWord(const std::string& key) {
  static const std::map<std::string, HeadingWord> kWords = allWords();
  const auto found = kWords.find(key);
  return found == kWords.end() ? HeadingWord::kNone : found->second;
}

}  // namespace mems_stiction
