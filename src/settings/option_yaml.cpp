#include "settings/option_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <locale>
#include <map>
#include <sstream>

#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "numeric/words.hpp"
#include "settings/yaml_text.hpp"

namespace mems_stiction {
namespace {

/// The whole text as a number, independent of the locale; nan and inf with or without YAML's
/// leading dot.
bool parseNumber(const std::string& text, double& value) {
  const std::string word = lowered(text);
  if (word == ".nan" || word == "nan") {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  for (const char* infinity : {".inf", "+.inf", "inf", "+inf"}) {
    if (word == infinity) {
      value = std::numeric_limits<double>::infinity();
      return true;
    }
  }
  if (word == "-.inf" || word == "-inf") {
    value = -std::numeric_limits<double>::infinity();
    return true;
  }
  // 010 is ten to some readers of YAML and eight to others.
  const std::size_t digit = text.find_first_not_of("+-");
  if (text.size() > digit + 1 && text[digit] == '0' &&
      std::isdigit(static_cast<unsigned char>(text[digit + 1])) != 0) {
    return false;
  }
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double parsed = 0.0;
  if (!(stream >> parsed) || !(stream >> std::ws).eof() || isLostInReading(text, parsed))
    return false;
  value = parsed;
  return true;
}

/// One key that the tree supplies.
struct Leaf {
  std::string key;
  YAML::Node node;
  int uses = 0;
};

/// Where the text has it: " in line 7"; empty for what came from no text.
std::string placeOf(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? "" : " in line " + std::to_string(mark.line + 1);
}

/// Of so many keys that nobody knows, or that are given twice, each is named: more are another
/// file.
constexpr std::size_t kMostUnknown = 100;

/// More or longer keys, and more maps within one another, are no settings: perhaps a tree that
/// contains itself.
constexpr std::size_t kMostKeys = 100'000;
constexpr std::size_t kLongestKey = 1000;

/// YAML forbids a key that one map has twice; programs that take the first, or the last, or both,
/// differ in what they then read. Beyond the limits nothing is added but a line that says so.
/// - @p depth maps that the node stands in
/// @return whether the tree is within the limits
bool flatten(const YAML::Node& node, const std::string& prefix, std::vector<Leaf>& leaves,
             std::vector<std::string>& lines, int depth = 0) {
  if (!node.IsMap()) {
    leaves.push_back({prefix, node});
    if (leaves.size() <= kMostKeys) return true;
    lines.push_back("more than " + std::to_string(kMostKeys) + " keys are given");
    return false;
  }
  if (depth >= kMaxYamlDepth) {
    lines.push_back(prefix.substr(0, 100) + "...: more than " + std::to_string(kMaxYamlDepth) +
                    " maps within one another are given; does the tree contain itself?");
    return false;
  }
  if (prefix.size() > kLongestKey) {
    lines.push_back(prefix.substr(0, 100) + "...: a key of " + std::to_string(prefix.size()) +
                    " bytes is given");
    return false;
  }
  std::map<std::string, YAML::Node> seen;
  for (const auto& entry : node) {
    const std::string name =
        entry.first.IsScalar() ? trimmed(entry.first.Scalar(), "/") : "(a key that is not text)";
    const std::string key = prefix.empty() ? name : prefix + "/" + name;
    const auto [first, is_new] = seen.emplace(name, entry.first);
    if (!is_new) {
      lines.push_back(shortened(key, kLongestQuotation) + ": given" + placeOf(entry.first) +
                      " and before" + placeOf(first->second) +
                      ", must be given once: put what belongs to it together");
      if (lines.size() < kMostUnknown) continue;
      lines.emplace_back("perhaps more keys are given twice");
      return false;
    }
    if (!flatten(entry.second, key, leaves, lines, depth + 1)) return false;
  }
  return true;
}

/// " (write 0.05: ...)" for 0,05, " (write 0 ...)" for 1e-400; else empty.
std::string numberHint(const YAML::Node& node) {
  if (!node.IsScalar() || node.Scalar().size() > kLongestQuotation) return "";
  std::string text = node.Scalar();
  char* end = nullptr;
  if (isLostInReading(text, plainStrtod(text.c_str(), &end)) && *end == '\0')
    return " (write 0 for none: the number is too near to it)";
  if (std::count(text.begin(), text.end(), ',') != 1) return "";
  text[text.find(',')] = '.';
  double number = 0.0;
  return parseNumber(text, number) ? " (write " + text + ": the decimal sign is a point)" : "";
}

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + shortened(node.Scalar(), kLongestQuotation) + "'";
  return node.IsSequence() ? "a list" : "no value";
}

/// Of YAML's types.
constexpr const char* kTypeTag = "tag:yaml.org,2002:";

/// By a tag: that of typedNode(), or one that the text has ("!!int 17").
bool isTyped(const YAML::Node& node) {
  const std::string& tag = node.Tag();
  return tag == std::string(kTypeTag) + "int" || tag == std::string(kTypeTag) + "float" ||
         tag == std::string(kTypeTag) + "bool";
}

/// YAML's word for a flag; empty if it is none.
std::string flagOf(const std::string& text) {
  const std::string word = lowered(text);
  if (word == "true" || word == "yes" || word == "on") return "true";
  if (word == "false" || word == "no" || word == "off") return "false";
  return "";
}

/// Where true and false are among the choices, every word for them is.
std::string choiceOf(const std::string& text, const std::vector<std::string>& names) {
  const std::string flag = flagOf(text);
  return std::find(names.begin(), names.end(), flag) != names.end() ? flag : text;
}

/// Of a text that is a setting, such as the path of a file [bytes].
constexpr std::size_t kLongestText = 4096;

/// Takes each described field from the tree, if the tree names it, and checks its range by the
/// common validator.
class YamlReader : public OptionVisitor {
 public:
  explicit YamlReader(const YAML::Node& tree) {
    if (!tree.IsDefined() || tree.IsNull()) return;
    if (!tree.IsMap()) {
      lines_.push_back("the configuration must be a map of keys and values, got " + shown(tree));
      return;
    }
    flatten(tree, "", leaves_, lines_);
    for (std::size_t place = 0; place < leaves_.size(); ++place)
      places_[leaves_[place].key].push_back(place);
  }

  void number(const std::string& key, double& value, const std::string& unit, const Range& range,
              const std::string& meaning) override {
    const YAML::Node* const node = take(key);
    if (node != nullptr && (!node->IsScalar() || !parseNumber(node->Scalar(), value))) {
      wrongType(key, *node, "a number " + range.text() + (unit.empty() ? "" : " " + unit));
      return;
    }
    OptionValidator validator;
    validator.number(key, value, unit, range, meaning);
    append(validator);
  }

  void integer(const std::string& key, int& value, const Range& range,
               const std::string& meaning) override {
    if (const YAML::Node* node = take(key)) {
      double parsed = 0.0;
      // The limits of int keep the cast defined; the range is checked below.
      if (!node->IsScalar() || !parseNumber(node->Scalar(), parsed) ||
          parsed != std::floor(parsed) ||
          !(std::abs(parsed) <= static_cast<double>(std::numeric_limits<int>::max()))) {
        wrongType(key, *node, "an integer " + range.text());
        return;
      }
      value = static_cast<int>(parsed);
    }
    OptionValidator validator;
    validator.integer(key, value, range, meaning);
    append(validator);
  }

  void flag(const std::string& key, bool& value, const std::string& /*meaning*/) override {
    const YAML::Node* node = take(key);
    if (node == nullptr) return;
    const std::string word = node->IsScalar() ? flagOf(node->Scalar()) : "";
    if (word.empty()) {
      wrongType(key, *node, "true or false");
    } else {
      value = word == "true";
    }
  }

  void text(const std::string& key, std::string& value, const std::string& /*meaning*/) override {
    const YAML::Node* node = take(key);
    if (node == nullptr) return;
    if (!node->IsScalar()) {
      wrongType(key, *node, "a text");
    } else if (node->Scalar().size() > kLongestText) {
      lines_.push_back(key + ": a text of " + std::to_string(node->Scalar().size()) +
                       " bytes is not allowed, must have at most " + std::to_string(kLongestText));
    } else if (isTyped(*node)) {
      const std::string text = shortened(node->Scalar(), kLongestQuotation);
      lines_.push_back(key + ": " + text +
                       " came as a number or a flag, must be a text: quote it ('" + text +
                       "'), with the zeros that it may have lost");
    } else {
      value = node->Scalar();
    }
  }

  void choice(const std::string& key, std::string& value, const std::vector<std::string>& names,
              const std::string& meaning) override {
    if (const YAML::Node* node = take(key))
      value = node->IsScalar() ? choiceOf(node->Scalar(), names) : shown(*node);
    OptionValidator validator;
    validator.choice(key, value, names, meaning);
    append(validator);
  }

  void formerName(const std::string& former, const std::string& key) override {
    former_names_[former] = key;
  }

  /// Call after every field was shown.
  std::vector<std::string> violations() const {
    std::vector<std::string> lines = lines_;
    std::size_t unknown_count = 0;
    for (const Leaf& leaf : leaves_) {
      const std::string section = leaf.key + "/";
      const bool is_section =
          std::any_of(known_.begin(), known_.end(),
                      [&](const std::string& key) { return startsWith(key, section); });
      const bool empty_section = leaf.node.IsNull() && is_section;
      if (leaf.uses == 0 && !empty_section) {
        if (++unknown_count > kMostUnknown) continue;
        if (is_section) {
          lines.push_back(leaf.key + ": " + shown(leaf.node) +
                          " is given, must be a section with settings of its own");
          continue;
        }
        const auto former = former_names_.find(leaf.key);
        if (former != former_names_.end()) {
          lines.push_back(leaf.key + ": " + shown(leaf.node) + " is given, but its name is " +
                          former->second + " now");
          continue;
        }
        const std::string name = lastPart(leaf.key);
        const bool is_fraction =
            leaf.node.IsNull() && !name.empty() &&
            name.find_first_not_of("0123456789") == std::string::npos;  // {voltage: 0,05}
        lines.push_back(shortened(leaf.key, kLongestQuotation) + ": " + shown(leaf.node) +
                        " is given, but there is no such setting" +
                        (is_fraction
                             ? " (is it behind a decimal comma? the decimal sign is a point)"
                             : suggestion(leaf.key, known_)));
      }
    }
    if (unknown_count > kMostUnknown) {
      lines.push_back(std::to_string(unknown_count - kMostUnknown) +
                      " more keys are given that are no settings");
    }
    return lines;
  }

 private:
  /// The value that the tree gives for the key, or null. A second one is a violation.
  const YAML::Node* take(const std::string& key) {
    known_.push_back(key);
    const YAML::Node* found = nullptr;
    const auto places = places_.find(key);
    if (places == places_.end()) return nullptr;
    for (const std::size_t place_of_leaf : places->second) {
      Leaf& leaf = leaves_[place_of_leaf];
      ++leaf.uses;
      if (found != nullptr) {
        const std::string place = placeOf(leaf.node);
        lines_.push_back(key + ": " + shown(leaf.node) + " is given beside " + shown(*found) +
                         placeOf(*found) + (place.empty() ? "" : " and" + place) +
                         ", must be given once");
      } else {
        found = &leaf.node;
      }
    }
    return found;
  }

  void wrongType(const std::string& key, const YAML::Node& node, const std::string& allowed) {
    lines_.push_back(key + ": " + shown(node) + " is not allowed, must be " + allowed +
                     numberHint(node));
  }

  void append(const OptionValidator& validator) {
    lines_.insert(lines_.end(), validator.violations().begin(), validator.violations().end());
  }

  std::vector<Leaf> leaves_;
  std::map<std::string, std::vector<std::size_t>> places_;  ///< in leaves_, of each key
  std::vector<std::string> known_;
  std::map<std::string, std::string> former_names_;  ///< what they are called now
  std::vector<std::string> lines_;
};

/// Writes sections as they come; a section's keys are described together.
class YamlWriter : public OptionVisitor {
 public:
  void number(const std::string& key, double& value, const std::string& unit, const Range& range,
              const std::string& meaning) override {
    line(key, yamlNumber(value),
         (unit.empty() ? "" : "[" + unit + "] ") + meaning + "; " + range.text());
  }
  void integer(const std::string& key, int& value, const Range& range,
               const std::string& meaning) override {
    line(key, std::to_string(value), meaning + "; an integer " + range.text());
  }
  void flag(const std::string& key, bool& value, const std::string& meaning) override {
    line(key, value ? "true" : "false", meaning);
  }
  void text(const std::string& key, std::string& value, const std::string& meaning) override {
    line(key, quoted(value), meaning);
  }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>& names,
              const std::string& meaning) override {
    line(key, quoted(value), meaning + "; one of: " + listed(names));
  }

  const std::string& text() const { return text_; }

 private:
  static std::string quoted(const std::string& value) {
    YAML::Emitter emitter;
    emitter << YAML::DoubleQuoted << value;
    return emitter.c_str();
  }

  void line(const std::string& key, const std::string& value, const std::string& comment) {
    const std::size_t slash = key.find('/');
    const std::string section = slash == std::string::npos ? "" : key.substr(0, slash);
    if (section != section_ && !section.empty()) text_ += section + ":\n";
    section_ = section;
    text_ += section.empty() ? key : "  " + key.substr(slash + 1);
    text_ += ": " + value + "  # " + comment + "\n";
  }

  std::string section_;
  std::string text_;
};

}  // namespace

std::vector<std::string> readYaml(const YAML::Node& tree, const DescribeFunction& describe) {
  YamlReader reader(tree);
  describe(reader);
  return reader.violations();
}

std::vector<std::pair<std::string, YAML::Node>> statedIn(const YAML::Node& tree) {
  std::vector<Leaf> leaves;
  std::vector<std::string> ignored;
  if (tree.IsDefined() && tree.IsMap()) flatten(tree, "", leaves, ignored);
  std::vector<std::pair<std::string, YAML::Node>> stated;
  stated.reserve(leaves.size());
  for (const Leaf& leaf : leaves) stated.emplace_back(leaf.key, leaf.node);
  return stated;
}

std::vector<std::string> keysOf(const YAML::Node& tree) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : statedIn(tree)) keys.push_back(key);
  return keys;
}

YAML::Node withoutKeys(const YAML::Node& tree, const std::vector<std::string>& keys) {
  const auto isOne = [&](const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  const std::vector<std::string> stated = keysOf(tree);
  if (std::none_of(stated.begin(), stated.end(), isOne)) return tree;
  YAML::Node rest(YAML::NodeType::Map);
  for (const auto& [key, value] : statedIn(tree)) {
    if (!isOne(key)) rest.force_insert(key, value);
  }
  return rest;
}

std::vector<std::string> emptyPartsOf(const YAML::Node& tree) {
  if (!tree.IsDefined() || tree.IsNull()) return {"states nothing, the defaults hold"};
  std::vector<std::string> lines;
  for (const auto& [key, value] : statedIn(tree)) {
    if (value.IsNull()) lines.push_back(key + ": has nothing below it, the defaults hold");
  }
  return lines;
}

YAML::Node typedNode(const std::string& value, const std::string& type) {
  YAML::Node node(value);
  node.SetTag(kTypeTag + type);
  return node;
}

std::string toYaml(const DescribeFunction& describe) {
  YamlWriter writer;
  describe(writer);
  return writer.text();
}

std::string yamlNumber(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  std::string text = numberText(value);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos)
    text.insert(exponent, ".0");
  return text;
}

}  // namespace mems_stiction
