#include "import/stated_twice.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kCreatecText = 16384;    // [bytes]
constexpr std::size_t kMostSxmText = 1 << 20;  // [bytes]

/// What a header states of size and scale, under one spelling of each key.
class StatedOnce {
 public:
  void add(const std::string& key, const std::string& value) {
    const auto [stated, is_new] = values_.emplace(key, value);
    if (is_new || stated->second == value) return;
    throw FileError("the header states '" + shownPiece(key) + "' twice, as '" +
                    shownPiece(stated->second) + "' and '" + shownPiece(value) +
                    "': damaged, or joined from two files");
  }

 private:
  std::map<std::string, std::string> values_;
};

std::string joinedWords(const std::string& text) {
  std::string joined;
  for (const std::string& word : wordsOf(text)) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

/// Nanonis: ":KEY:" on a line, its value on those below. The table of channels, DATA_INFO, is one
/// value.
void checkSxm(const std::string& bytes) {
  std::istringstream header(bytes.substr(0, std::min(bytes.find(":SCANIT_END:"), kMostSxmText)));
  StatedOnce once;
  std::string key;
  std::string value;
  const auto end = [&] {
    const bool counts = key == "scanit_type" || key == "data_info" || startsWith(key, "scan_") ||
                        key.find("gain") != std::string::npos ||
                        key.find("calibration") != std::string::npos ||
                        key.find("calib") != std::string::npos;
    if (counts) once.add(key, joinedWords(value));
    value.clear();
  };
  for (std::string line; std::getline(header, line);) {
    const std::string text = trimmed(line, " \t\r");
    if (text.size() > 2 && text.front() == ':' && text.back() == ':') {
      end();
      key = lowered(text.substr(1, text.size() - 2));
    } else {
      value += " " + text;
    }
  }
  end();
}

/// Createc: "Num.X=512", or "GainX / GainX=10" with the name of before beside the new one.
void checkCreatecKeys(const std::string& bytes) {
  static const std::vector<std::string> kKeys = {
      "num.x",    "num.y",       "delta x",     "delta y",     "gainx",       "gainy",
      "gainz",    "xpiezoconst", "ypiezoconst", "zpiezoconst", "length x[a]", "length y[a]",
      "dac-type", "channels",    "dacto[a]xy",  "dacto[a]z"};
  const std::size_t data = bytes.find('\0');
  std::istringstream header(bytes.substr(0, std::min({bytes.size(), kCreatecText, data})));
  StatedOnce once;
  for (std::string line; std::getline(header, line);) {
    const std::size_t sign = line.find('=');
    if (sign == std::string::npos) continue;
    std::string key = lowered(trimmed(line.substr(0, sign), " \t\r"));
    key = trimmed(key.substr(0, key.find(" / ")), " \t");
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) continue;
    once.add(key, joinedWords(trimmed(line.substr(sign + 1), " \t\r")));
  }
}

}  // namespace

void checkStatedTwice(const std::string& bytes) {
  if (startsWith(bytes, ":NANONIS_VERSION:")) checkSxm(bytes);
  for (const char* start : {"[Parameter]", "[Paramet32]", "[Paramco32]"}) {
    if (startsWith(bytes, start)) checkCreatecKeys(bytes);
  }
}

}  // namespace mems_stiction
