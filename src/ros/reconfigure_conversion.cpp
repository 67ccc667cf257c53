#include "ros/reconfigure_conversion.hpp"

#include <algorithm>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

std::string shortName(const std::string& key) { return key.substr(key.rfind('/') + 1); }

/// Writes every field into the message.
class Writer : public OptionVisitor {
 public:
  explicit Writer(dynamic_reconfigure::Config& message) : message_(message) {}

  void number(const std::string& key, double& value, const std::string&, const Range&, const std::string&) override {
    add(message_.doubles, key, value);
  }
  void integer(const std::string& key, int& value, const Range&, const std::string&) override {
    add(message_.ints, key, value);
  }
  void flag(const std::string& key, bool& value, const std::string&) override { add(message_.bools, key, value); }
  void text(const std::string& key, std::string& value, const std::string&) override { add(message_.strs, key, value); }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>&,
              const std::string&) override {
    add(message_.strs, key, value);
  }

 private:
  template <typename List, typename Value>
  void add(List& list, const std::string& key, const Value& value) {
    typename List::value_type entry;
    entry.name = shortName(key);
    entry.value = value;
    list.push_back(entry);
  }

  dynamic_reconfigure::Config& message_;
};

/// Reads every field that the message has.
class Reader : public OptionVisitor {
 public:
  explicit Reader(const dynamic_reconfigure::Config& message) : message_(message) {}

  void number(const std::string& key, double& value, const std::string&, const Range&, const std::string&) override {
    take(message_.doubles, key, value);
  }
  void integer(const std::string& key, int& value, const Range&, const std::string&) override {
    take(message_.ints, key, value);
  }
  void flag(const std::string& key, bool& value, const std::string&) override { take(message_.bools, key, value); }
  void text(const std::string& key, std::string& value, const std::string&) override {
    take(message_.strs, key, value);
  }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>& names,
              const std::string&) override {
    take(message_.strs, key, value);
    if (std::find(names.begin(), names.end(), value) != names.end()) return;
    std::string line = key + ": '" + value + "' is not allowed, must be one of";
    for (const std::string& name : names) line += " " + name;
    violations_.push_back(line);
  }

  const std::vector<std::string>& violations() const { return violations_; }

 private:
  template <typename List, typename Value>
  void take(const List& list, const std::string& key, Value& value) {
    for (const auto& entry : list) {
      if (entry.name == shortName(key)) value = entry.value;
    }
  }

  const dynamic_reconfigure::Config& message_;
  std::vector<std::string> violations_;
};

}  // namespace

dynamic_reconfigure::Config reconfigureMessage(const RunningSettings& settings) {
  dynamic_reconfigure::Config message;
  Writer writer(message);
  describeConst(settings, writer);
  return message;
}

void applyReconfigure(const dynamic_reconfigure::Config& message, RunningSettings& settings) {
  RunningSettings changed = settings;
  Reader reader(message);
  changed.describe(reader);
  if (!reader.violations().empty()) throw OptionsError(reader.violations());
  settings = changed;
}

}  // namespace mems_stiction
