#include "mems_stiction/scan/record.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "mems_stiction/base/option_yaml.hpp"
#include "mems_stiction/base/short_number.hpp"
#include "mems_stiction/half_space/half_space_fields.hpp"
#include "mems_stiction/prediction/prediction_fields.hpp"
#include "mems_stiction/verdict/regime_flags.hpp"
#include "mems_stiction/verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace {

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
    } else if constexpr (std::is_same_v<Value, std::string> || std::is_same_v<Value, Sticks>) {
      emitter_ << YAML::DoubleQuoted << std::string(shown(value));
    } else {
      emitter_ << word(value);
    }
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

 private:
  nlohmann::json& object_;
};

/// Size and pitch of the scan: what a reader needs to trust the figures below.
template <typename Visitor>
void visitScanFields(const HeightMap& scan, Visitor&& visit) {
  visit({"rows"}, scan.rows());
  visit({"cols"}, scan.cols());
  visit({"pitch_x", "m"}, scan.pitchX());
  visit({"pitch_y", "m"}, scan.pitchY());
}

/// Figures of the prediction and of the verdict, and what limits both.
template <typename Visitor>
void visitResultFields(const HeightMap& scan, const Prediction& prediction, const RecordExtras& extras,
                       Visitor&& visit) {
  if (extras.provenance) {
    visitProvenanceFields(*extras.provenance, [&](const Figure& figure, const std::string& value) {
      if (!value.empty()) visit(figure, value);
    });
  }
  if (!extras.formulation.empty()) visit({"formulation"}, extras.formulation);
  visitPredictionFields(prediction, [&](const Figure& figure, const auto& value) {
    const bool verdict_has_it = extras.verdict && std::strcmp(figure.name, "apparent_work_of_adhesion") == 0;
    if (!verdict_has_it) visit(figure, value);
  });
  const std::uint32_t flags = regimeFlags(prediction, scan.cellArea());
  visit({"regime_flag_names"}, regimeFlagNames(flags));
  if (extras.verdict) {
    visitVerdictFields(*extras.verdict, visit);
    if (extras.half_space) visit({"verdict_by"}, std::string(judgeText(extras.verdict->judge)));
  } else {
    visit({"regime_flags"}, flags);
  }
}

template <typename Visitor>
void visitStepFields(const PreprocessStep& step, Visitor&& visit) {
  visit({"step"}, step.name);
  visit({"parameters"}, step.parameters);
  visit({"rms_change", "m"}, step.rms_change);
  visit({"changed_pixels"}, step.changed_pixels);
  visit({"invalid_pixels"}, step.invalid_pixels);
}

bool hasTipStep(const PreprocessRecord& record) {
  return std::any_of(record.steps.begin(), record.steps.end(),
                     [](const PreprocessStep& step) { return step.name == "tip"; });
}

bool isComputed(const SpatialRoughness& roughness) { return !std::isnan(roughness.sal); }

/// A list of flow maps under `name`, left out when it is empty.
template <typename Items, typename VisitItem>
void addYamlList(YAML::Emitter& emitter, const char* name, const Items& items, VisitItem visit_item) {
  if (items.empty()) return;
  YamlFields fields(emitter);
  emitter << YAML::Key << name << YAML::Value << YAML::BeginSeq;
  for (const auto& item : items) {
    emitter << YAML::Flow << YAML::BeginMap;
    visit_item(item, fields);
    emitter << YAML::EndMap;
  }
  emitter << YAML::EndSeq;
}

template <typename Items, typename VisitItem>
void addJsonList(nlohmann::json& record, const char* name, const Items& items, VisitItem visit_item) {
  for (const auto& item : items) {
    nlohmann::json entry;
    visit_item(item, JsonFields(entry));
    record[name].push_back(entry);
  }
}

const auto kVisitStep = [](const auto& item, auto&& fields) { visitStepFields(item, fields); };
const auto kVisitPoint = [](const auto& item, auto&& fields) { visitEnergyPointFields(item, fields); };
const auto kVisitCurvePoint = [](const auto& item, auto&& fields) { visitCurvePointFields(item, fields); };
const auto kVisitSeparationPoint = [](const auto& item, auto&& fields) { visitSeparationPointFields(item, fields); };
const auto kVisitCleaning = [](const auto& item, auto&& fields) { visitCleaningFields(item, fields); };
const auto kVisitRow = [](const auto& item, auto&& fields) { visitConvergenceFields(item, fields); };

/// Pull-off force and margin for people.
std::string summaryComment(const Prediction& prediction, const RecordExtras& extras) {
  if (!extras.pull_off_interval) return "";
  const ForceInterval& interval = *extras.pull_off_interval;
  std::string text = "# Pull-off force " + withInterval(prediction.pull_off_force, interval.lower, interval.upper, "N");
  if (prediction.isLowerBound()) text += ", a lower bound";
  if (extras.verdict && !std::isnan(extras.verdict->margin)) {
    const Verdict& verdict = *extras.verdict;
    text += "; margin " + withInterval(verdict.margin, verdict.margin_lower, verdict.margin_upper);
  }
  return text + ".\n";
}

}  // namespace

std::string yamlRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const RecordExtras& extras) {
  YAML::Emitter emitter;
  YamlFields fields(emitter);
  emitter << YAML::BeginDoc << YAML::BeginMap;
  fields({"file"}, file);
  if (!extras.channel.empty()) fields({"channel"}, extras.channel);
  visitScanFields(scan, fields);
  visitResultFields(scan, prediction, extras, fields);
  emitter << YAML::Key << "roughness" << YAML::Value << YAML::BeginMap;
  visitRoughnessFields(prediction.roughness, fields);
  if (isComputed(prediction.spatial_roughness)) visitSpatialRoughnessFields(prediction.spatial_roughness, fields);
  emitter << YAML::EndMap;
  if (!extras.warnings.empty()) {
    emitter << YAML::Key << "warnings" << YAML::Value << YAML::BeginSeq;
    for (const std::string& warning : extras.warnings) emitter << YAML::DoubleQuoted << warning;
    emitter << YAML::EndSeq;
  }
  addYamlList(emitter, "preprocessing", extras.preprocessing.steps, kVisitStep);
  if (hasTipStep(extras.preprocessing)) {
    fields({"tip_unreached_fraction"}, extras.preprocessing.tip_unreached_fraction);
  }
  addYamlList(emitter, "convergence", extras.convergence, kVisitRow);
  addYamlList(emitter, "cleanings", extras.cleanings, kVisitCleaning);
  if (!extras.cleanings.empty()) {
    emitter << YAML::Key << "cleaning_spread" << YAML::Value << YAML::BeginMap;
    visitSpreadFields(spreadOf(extras.cleanings), fields);
    emitter << YAML::EndMap;
  }
  addYamlList(emitter, "energy_curve", prediction.energy_curve, kVisitPoint);
  if (extras.has_curve) addYamlList(emitter, "curve", prediction.curve, kVisitSeparationPoint);
  if (extras.half_space) {
    emitter << YAML::Key << "half_space" << YAML::Value << YAML::BeginMap;
    visitHalfSpaceFields(*extras.half_space, fields);
    addYamlList(emitter, "curve", curveOf(*extras.half_space), kVisitCurvePoint);
    emitter << YAML::EndMap;
  }
  emitter << YAML::EndMap;
  std::string text = std::string(emitter.c_str()) + "\n";
  text += summaryComment(prediction, extras);
  if (!extras.convergence.empty()) text += convergenceTable(extras.convergence, "# ");
  if (!extras.cleanings.empty()) text += cleaningTable(extras.cleanings, "# ");
  return text;
}

std::string jsonRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const RecordExtras& extras) {
  nlohmann::json record;
  record["file"] = file;
  if (!extras.channel.empty()) record["channel"] = extras.channel;
  JsonFields fields(record);
  visitScanFields(scan, fields);
  visitResultFields(scan, prediction, extras, fields);
  nlohmann::json roughness;
  visitRoughnessFields(prediction.roughness, JsonFields(roughness));
  if (isComputed(prediction.spatial_roughness)) {
    visitSpatialRoughnessFields(prediction.spatial_roughness, JsonFields(roughness));
  }
  record["roughness"] = roughness;
  if (!extras.warnings.empty()) record["warnings"] = extras.warnings;
  addJsonList(record, "preprocessing", extras.preprocessing.steps, kVisitStep);
  if (hasTipStep(extras.preprocessing)) {
    record["tip_unreached_fraction"] = extras.preprocessing.tip_unreached_fraction;
  }
  addJsonList(record, "convergence", extras.convergence, kVisitRow);
  addJsonList(record, "cleanings", extras.cleanings, kVisitCleaning);
  if (!extras.cleanings.empty()) visitSpreadFields(spreadOf(extras.cleanings), JsonFields(record["cleaning_spread"]));
  addJsonList(record, "energy_curve", prediction.energy_curve, kVisitPoint);
  if (extras.has_curve) addJsonList(record, "curve", prediction.curve, kVisitSeparationPoint);
  if (extras.half_space) {
    nlohmann::json half_space;
    visitHalfSpaceFields(*extras.half_space, JsonFields(half_space));
    addJsonList(half_space, "curve", curveOf(*extras.half_space), kVisitCurvePoint);
    record["half_space"] = half_space;
  }
  // A file name need not be UTF-8; a bad byte becomes U+FFFD instead of an exception.
  return record.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace mems_stiction
