#pragma once

/// @file
/// One table of settings, many uses. Every options struct describes its fields to a visitor: key,
/// unit, allowed range and meaning. Reading YAML, the ROS parameter server, validation, the printed
/// effective configuration and the parameter documentation are visitors, so they cannot disagree
/// about a key or a range.
///
/// A visitor may write to what it sees; describeConst() gives it a copy. Degenerate cases:
/// infinities lie in no range, NaN only in one where it means "none"; an unknown name of an
/// enumeration leaves the previous value.
///
///     PipelineOptions options;
///     options.fill.max_fraction = 2.0;
///     // key, value, what is allowed
///     for (const std::string& violation : rangeViolations(options)) report(violation);

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace mems_stiction {

/// The closed or half-open interval that a number must lie in. Infinities never do; NaN only where
/// it means "none".
struct Range {
  /// Smaller positive numbers are no length, force, stress or ratio: their products may vanish.
  static constexpr double kSmallest = 1e-30;

  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;
  bool nan_means_none = false;

  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
  static Range nonNegative() {
    return {0.0, std::numeric_limits<double>::infinity(), false, false};
  }
  static Range any() { return {}; }
  static Range anyOrNone() { return {any().lower, any().upper, false, false, true}; }
  static Range within(double lower, double upper) { return {lower, upper, false, false}; }
  static Range openWithin(double lower, double upper) { return {lower, upper, true, true}; }

  bool contains(double value) const;
  /// The constraint in words, for messages: "> 0", ">= 0", "in [0, 1]", "any finite number" (", or
  /// nan for none").
  std::string text() const;
};

/// Sees every field of an options struct once, in the order of the documentation.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;

  virtual void number(const std::string& key, double& value, const std::string& unit,
                      const Range& range, const std::string& meaning) = 0;
  virtual void integer(const std::string& key, int& value, const Range& range,
                       const std::string& meaning) = 0;
  virtual void flag(const std::string& key, bool& value, const std::string& meaning) = 0;
  virtual void text(const std::string& key, std::string& value, const std::string& meaning) = 0;
  /// `value` is one of `names`.
  virtual void choice(const std::string& key, std::string& value,
                      const std::vector<std::string>& names, const std::string& meaning) = 0;
  /// Earlier versions called `key` so: whoever still does is told.
  virtual void formerName(const std::string& /*former*/, const std::string& /*key*/) {}

  /// An enumeration, through choice(). A value that choice() leaves outside the table keeps the
  /// previous enumerator.
  template <typename Enum>
  void enumeration(const std::string& key, Enum& value,
                   const std::vector<std::pair<std::string, Enum>>& table,
                   const std::string& meaning) {
    std::vector<std::string> names;
    std::string name;
    for (const auto& entry : table) {
      names.push_back(entry.first);
      if (entry.second == value) name = entry.first;
    }
    choice(key, name, names, meaning);
    for (const auto& entry : table) {
      if (entry.first == name) value = entry.second;
    }
  }
};

/// Checks every described field against its range and collects the violations as readable lines.
class OptionValidator : public OptionVisitor {
 public:
  void number(const std::string& key, double& value, const std::string& unit, const Range& range,
              const std::string& meaning) override;
  void integer(const std::string& key, int& value, const Range& range,
               const std::string& meaning) override;
  void flag(const std::string& key, bool& value, const std::string& meaning) override;
  void text(const std::string& key, std::string& value, const std::string& meaning) override;
  void choice(const std::string& key, std::string& value, const std::vector<std::string>& names,
              const std::string& meaning) override;

  const std::vector<std::string>& violations() const { return violations_; }

 private:
  std::vector<std::string> violations_;
};

/// describe() of options that must stay as they are: what the visitor sees, and could write to, is
/// a copy.
/// - @p arguments of describe() after the visitor, such as a prefix
template <typename Options, typename... Arguments>
void describeConst(const Options& options, OptionVisitor& visitor, const Arguments&... arguments) {
  Options copy = options;
  copy.describe(visitor, arguments...);
}

/// One line per described field that is out of its range; empty when all is well.
/// - @p arguments of describe() after the visitor, such as a prefix
template <typename Options, typename... Arguments>
std::vector<std::string> rangeViolations(const Options& options, const Arguments&... arguments) {
  OptionValidator validator;
  describeConst(options, validator, arguments...);
  return validator.violations();
}

/// Shortest decimal text that reads back as the same double: for messages and printed
/// configurations.
std::string numberText(double value);

}  // namespace mems_stiction
