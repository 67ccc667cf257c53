#include "settings/yaml_text.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

/// What aliases may stand for, where the text itself has less.
constexpr std::uint64_t kMaxValues = 10'000;
constexpr std::uint64_t kMaxBytes = 1'000'000;

/// Number of the first line that begins with a tab, behind spaces or not; 0: none.
std::size_t lineWithTab(const std::string& text) {
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t first = text.find_first_not_of(' ', begin);
    if (first != std::string::npos && text[first] == '\t') return number;
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return 0;
}

/// UTF-16 and UTF-32 have bytes 0 by themselves; their files begin with a byte order mark.
bool hasWideLetters(const std::string& text) {
  return startsWith(text, "\xFF\xFE") || startsWith(text, "\xFE\xFF") ||
         startsWith(text, std::string("\0\0\xFE\xFF", 4));
}

/// The parser takes a byte 0 for one of its own signs. @throw FileError
void requireNoZeroByte(const std::string& text, const std::string& name) {
  const std::size_t zero = text.find('\0');
  if (zero == std::string::npos || hasWideLetters(text)) return;
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(zero);
  throw FileError(name + ": is not a text, so no file of settings: line " +
                  std::to_string(1 + std::count(text.begin(), end, '\n')) + " has a byte 0");
}

bool isBinary(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return code < 0x20 && letter != '\t' && letter != '\n' && letter != '\r';
  });
}

/// What a node holds with all that its aliases stand for.
struct NodeSize {
  std::uint64_t values = 1;
  std::uint64_t bytes = 0;  ///< of all its scalars
  int levels = 0;           ///< of maps and lists below one another, itself among them
};

/// Measures a document as the parser reads it. @throw FileError beyond the limits
class YamlMeter : public YAML::EventHandler {
 public:
  YamlMeter(const std::string& name, std::uint64_t text_size)
      : name_(name),
        max_values_(std::max(kMaxValues, text_size)),
        max_bytes_(std::max(kMaxBytes, text_size)) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 1) return;
    refuse(mark,
           "a second document begins, must be one: put what belongs together under one key, and "
           "leave out --- and ...");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(mark, anchor, {}); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string& value) override {
    if (value.find('\0') != std::string::npos) refuse(mark, "a text has a byte 0; must not");
    add(mark, anchor, {1, value.size(), 0});
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto named = sizes_.find(anchor);
    if (named == sizes_.end()) {
      refuse(mark,
             "an alias stands inside what it names, so that the text contains itself; must not");
    }
    add(mark, YAML::NullAnchor, named->second);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  struct OpenNode {
    YAML::anchor_t anchor;
    YAML::Mark mark;
    NodeSize size;
  };

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& why) const {
    throw FileError(name_ + ": line " + std::to_string(mark.line + 1) + ": " + why);
  }

  void open(const YAML::Mark& mark, YAML::anchor_t anchor) {
    open_.push_back({anchor, mark, {1, 0, 1}});
    checkLevels(mark, static_cast<int>(open_.size()));
  }

  void close() {
    const OpenNode node = open_.back();
    open_.pop_back();
    add(node.mark, node.anchor, node.size);
  }

  /// A node that is complete, to what it stands in.
  void add(const YAML::Mark& mark, YAML::anchor_t anchor, const NodeSize& size) {
    if (anchor != YAML::NullAnchor) sizes_[anchor] = size;
    checkLevels(mark, static_cast<int>(open_.size()) + size.levels);
    if (open_.empty()) return;
    NodeSize& whole = open_.back().size;
    whole.values += size.values;
    whole.bytes += size.bytes;
    whole.levels = std::max(whole.levels, size.levels + 1);
    if (whole.values > max_values_) {
      refuse(mark, "the text holds more than " + std::to_string(max_values_) +
                       " values, as aliases stand for many");
    }
    if (whole.bytes > max_bytes_) {
      refuse(mark, "the text holds more than " + std::to_string(max_bytes_) +
                       " bytes, as aliases stand for many");
    }
  }

  void checkLevels(const YAML::Mark& mark, int levels) const {
    if (levels <= kMaxYamlDepth) return;
    refuse(mark, "more than " + std::to_string(kMaxYamlDepth) +
                     " levels of maps and lists below one another");
  }

  const std::string& name_;
  std::uint64_t max_values_;
  std::uint64_t max_bytes_;
  int documents_ = 0;
  std::vector<OpenNode> open_;
  std::map<YAML::anchor_t, NodeSize> sizes_;  ///< of anchored nodes that are complete
};

}  // namespace

YAML::Node parseYaml(const std::string& text, const std::string& name) {
  requireNoZeroByte(text, name);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    YamlMeter meter(name, text.size());
    if (parser.HandleNextDocument(meter)) parser.HandleNextDocument(meter);
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    if (isBinary(text)) throw FileError(name + ": is not a text, so no file of settings");
    const std::size_t line = lineWithTab(text);
    if (line == 0) throw FileError(name + ": not valid YAML: " + error.what());
    throw FileError(name + ": not valid YAML: line " + std::to_string(line) +
                    " begins with a tab; must be spaces (" + error.what() + ")");
  }
}

}  // namespace mems_stiction
