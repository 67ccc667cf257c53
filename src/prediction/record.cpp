#include "mems_stiction/prediction/record.hpp"

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>

#include "mems_stiction/base/option_yaml.hpp"
#include "mems_stiction/prediction/prediction_fields.hpp"

namespace mems_stiction {
namespace {

/// Visitor that adds fields to the map which the emitter has open.
class YamlFields {
 public:
  explicit YamlFields(YAML::Emitter& emitter) : emitter_(emitter) {}

  void operator()(const char* name, double value, const char* /*unit*/) { pair(name, yamlNumber(value)); }
  void operator()(const char* name, int value, const char* /*unit*/) { pair(name, std::to_string(value)); }
  template <typename Enum>
  void operator()(const char* name, Enum value, const char* /*unit*/) {
    pair(name, word(value));
  }

 private:
  void pair(const char* name, const std::string& value) { emitter_ << YAML::Key << name << YAML::Value << value; }

  YAML::Emitter& emitter_;
};

/// Visitor that adds fields to a JSON object.
class JsonFields {
 public:
  explicit JsonFields(nlohmann::json& object) : object_(object) {}

  void operator()(const char* name, double value, const char* /*unit*/) { object_[name] = value; }
  void operator()(const char* name, int value, const char* /*unit*/) { object_[name] = value; }
  template <typename Enum>
  void operator()(const char* name, Enum value, const char* /*unit*/) {
    object_[name] = word(value);
  }

 private:
  nlohmann::json& object_;
};

/// Size and pitch of the scan: what a reader needs to trust the figures below.
template <typename Visitor>
void visitScanFields(const HeightMap& scan, Visitor&& visit) {
  visit("rows", scan.rows(), "");
  visit("cols", scan.cols(), "");
  visit("pitch_x", scan.pitchX(), "m");
  visit("pitch_y", scan.pitchY(), "m");
}

}  // namespace

std::string yamlRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const std::string& channel) {
  YAML::Emitter emitter;
  YamlFields fields(emitter);
  emitter << YAML::BeginDoc << YAML::BeginMap;
  emitter << YAML::Key << "file" << YAML::Value << YAML::DoubleQuoted << file;
  if (!channel.empty()) emitter << YAML::Key << "channel" << YAML::Value << YAML::DoubleQuoted << channel;
  visitScanFields(scan, fields);
  visitPredictionFields(prediction, fields);
  emitter << YAML::Key << "roughness" << YAML::Value << YAML::BeginMap;
  visitRoughnessFields(prediction.roughness, fields);
  emitter << YAML::EndMap;
  if (!prediction.energy_curve.empty()) {
    emitter << YAML::Key << "energy_curve" << YAML::Value << YAML::BeginSeq;
    for (const EnergyPoint& point : prediction.energy_curve) {
      emitter << YAML::Flow << YAML::BeginMap;
      visitEnergyPointFields(point, fields);
      emitter << YAML::EndMap;
    }
    emitter << YAML::EndSeq;
  }
  emitter << YAML::EndMap;
  return std::string(emitter.c_str()) + "\n";
}

std::string jsonRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const std::string& channel) {
  nlohmann::json record;
  record["file"] = file;
  if (!channel.empty()) record["channel"] = channel;
  JsonFields fields(record);
  visitScanFields(scan, fields);
  visitPredictionFields(prediction, fields);
  nlohmann::json roughness;
  visitRoughnessFields(prediction.roughness, JsonFields(roughness));
  record["roughness"] = roughness;
  for (const EnergyPoint& point : prediction.energy_curve) {
    nlohmann::json entry;
    visitEnergyPointFields(point, JsonFields(entry));
    record["energy_curve"].push_back(entry);
  }
  // A file name need not be UTF-8; a bad byte becomes U+FFFD instead of an exception.
  return record.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace mems_stiction
