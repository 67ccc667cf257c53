#pragma once

/// @file
/// Figures as the fields of a record: what records of scans and devices are written with.

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "mems_stiction/settings/figure.hpp"
#include "settings/option_yaml.hpp"
#include "station/load_sweep.hpp"
#include "verdict/verdict_fields.hpp"

namespace mems_stiction {

/// Its words are "no" and "yes", which YAML would take for truth values.
template <typename Value>
constexpr bool isAnswer() {
  return std::is_same_v<Value, Sticks> || std::is_same_v<Value, Lands>;
}

/// Visitor that adds fields to the map which the emitter has open.
class YamlFields {
 public:
  explicit YamlFields(YAML::Emitter& emitter) : emitter_(emitter) {}

  template <typename Value>
  void operator()(const Figure& figure, const Value& value) {
    emitter_ << YAML::Key << figure.name << YAML::Value;
    if constexpr (std::is_same_v<Value, double>) {
      emitter_ << yamlNumber(value);
    } else if constexpr (std::is_same_v<Value, bool>) {
      emitter_ << (value ? "true" : "false");
    } else if constexpr (std::is_arithmetic_v<Value>) {
      emitter_ << std::to_string(value);
    } else if constexpr (std::is_same_v<Value, std::string> || isAnswer<Value>()) {
      emitter_ << YAML::DoubleQuoted << std::string(shown(value));
    } else {
      emitter_ << word(value);
    }
  }
  template <typename Fill>
  void map(const char* name, Fill fill) {
    emitter_ << YAML::Key << name << YAML::Value << YAML::BeginMap;
    fill(*this);
    emitter_ << YAML::EndMap;
  }
  /// Flow maps.
  template <typename Items, typename VisitItem>
  void list(const char* name, const Items& items, VisitItem visit_item) {
    emitter_ << YAML::Key << name << YAML::Value << YAML::BeginSeq;
    for (const auto& item : items) {
      emitter_ << YAML::Flow << YAML::BeginMap;
      visit_item(item, *this);
      emitter_ << YAML::EndMap;
    }
    emitter_ << YAML::EndSeq;
  }
  void texts(const char* name, const std::vector<std::string>& texts) {
    emitter_ << YAML::Key << name << YAML::Value << YAML::BeginSeq;
    for (const std::string& text : texts) emitter_ << YAML::DoubleQuoted << text;
    emitter_ << YAML::EndSeq;
  }

 private:
  YAML::Emitter& emitter_;
};

/// Visitor that adds fields to a JSON object.
class JsonFields {
 public:
  explicit JsonFields(nlohmann::json& object) : object_(object) {}

  template <typename Value>
  void operator()(const Figure& figure, const Value& value) {
    object_[figure.name] = shown(value);
  }
  template <typename Fill>
  void map(const char* name, Fill fill) {
    JsonFields fields(object_[name]);
    fill(fields);
  }
  template <typename Items, typename VisitItem>
  void list(const char* name, const Items& items, VisitItem visit_item) {
    object_[name] = nlohmann::json::array();
    for (const auto& item : items) visit_item(item, JsonFields(object_[name].emplace_back()));
  }
  void texts(const char* name, const std::vector<std::string>& texts) { object_[name] = texts; }

 private:
  nlohmann::json& object_;
};

}  // namespace mems_stiction
