#pragma once

/// @file
/// What settings are, where unit, range and meaning do not matter.

#include <string>
#include <utility>
#include <vector>

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// The value of a setting as text: "2.5e-09", "4", "true", or the text itself.
inline std::string valueText(double value) { return numberText(value); }
inline std::string valueText(int value) { return std::to_string(value); }
inline std::string valueText(bool value) { return value ? "true" : "false"; }
inline std::string valueText(const std::string& value) { return value; }

/// Calls a function with the key of each setting and its value: a double, an int, a bool or a text.
/// That of a choice is its name.
template <typename Function>
class ValueVisitor : public OptionVisitor {
 public:
  explicit ValueVisitor(Function function) : function_(std::move(function)) {}

  void number(const std::string& key, double& value, const std::string&, const Range&,
              const std::string&) override {
    function_(key, value);
  }
  void integer(const std::string& key, int& value, const Range&, const std::string&) override {
    function_(key, value);
  }
  void flag(const std::string& key, bool& value, const std::string&) override {
    function_(key, value);
  }
  void text(const std::string& key, std::string& value, const std::string&) override {
    function_(key, value);
  }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>&,
              const std::string&) override {
    function_(key, value);
  }

 private:
  Function function_;
};

/// function(key, value) for each setting of the options.
/// - @p arguments of describe() after the visitor, such as a prefix
template <typename Options, typename Function, typename... Arguments>
void visitValues(const Options& options, Function function, const Arguments&... arguments) {
  ValueVisitor<Function> visitor(std::move(function));
  describeConst(options, visitor, arguments...);
}

}  // namespace mems_stiction
