#include "evaluation/record.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "device/device_force_fields.hpp"
#include "errors/short_number.hpp"
#include "evaluation/record_fields.hpp"
#include "half_space/half_space_fields.hpp"
#include "prediction/contact_solvers.hpp"
#include "prediction/prediction_fields.hpp"
#include "station/station_fields.hpp"
#include "station/sweep_table.hpp"
#include "verdict/finding.hpp"
#include "verdict/regime_flags.hpp"
#include "verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace {

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
void visitResultFields(const HeightMap& scan, const Prediction& prediction,
                       const RecordExtras& extras, Visitor&& visit) {
  if (extras.provenance) visitStatedProvenance(*extras.provenance, visit);
  if (!extras.formulation.empty()) visit({"formulation"}, extras.formulation);
  visitPredictionFields(prediction, [&](const Figure& figure, const auto& value) {
    if (hasFigure(extras.formulation, figure.name)) visit(figure, value);
  });
  const std::uint32_t flags = regimeFlags(prediction, scan.cellArea());
  visit({"regime_flag_names"}, regimeFlagNames(flags));
  visit({"model_doubt"}, modelDoubt(prediction));
  if (extras.verdict) {
    visitVerdictFields(*extras.verdict, visit);
    if (extras.half_space) visit({"verdict_by"}, std::string(judgeText(extras.verdict->judge)));
  } else {
    visit({"regime_flags"}, flags);
  }
}

bool hasTipStep(const PreprocessRecord& record) {
  return std::any_of(record.steps.begin(), record.steps.end(),
                     [](const PreprocessStep& step) { return step.name == "tip"; });
}

bool isComputed(const SpatialRoughness& roughness) { return !std::isnan(roughness.sal); }

const auto kVisitStep = [](const auto& item, auto&& fields) { visitStepFields(item, fields); };
const auto kVisitPoint = [](const auto& item, auto&& fields) {
  visitEnergyPointFields(item, fields);
};
const auto kVisitCurvePoint = [](const auto& item, auto&& fields) {
  visitCurvePointFields(item, fields);
};
const auto kVisitSeparationPoint = [](const auto& item, auto&& fields) {
  visitSeparationPointFields(item, fields);
};
const auto kVisitCleaning = [](const auto& item, auto&& fields) {
  visitCleaningFields(item, fields);
};
const auto kVisitSweepRow = [](const auto& item, auto&& fields) { visitSweepFields(item, fields); };
const auto kVisitSummary = [](const auto& item, auto&& fields) {
  visitSummaryFields(item, fields);
};
const auto kVisitRow = [](const auto& item, auto&& fields) {
  visitConvergenceFields(item, fields);
};

/// Visits those fields of an item that the formulation has.
template <typename VisitItem>
auto known(const std::string& formulation, const VisitItem& visit_item) {
  return [&formulation, &visit_item](const auto& item, auto&& fields) {
    visit_item(item, [&](const Figure& figure, const auto& value) {
      if (hasFigure(formulation, figure.name)) fields(figure, value);
    });
  };
}

/// Pull-off force and verdict for people.
std::string summaryComment(const Prediction& prediction, const RecordExtras& extras) {
  if (!extras.pull_off_interval) return "";
  const ForceInterval& interval = *extras.pull_off_interval;
  std::string text = "# Pull-off force " +
                     withInterval(prediction.pull_off_force, interval.lower, interval.upper, "N");
  if (prediction.isLowerBound()) text += ", a lower bound";
  text += ".\n";
  if (extras.verdict) text += "# " + verdictSentence(*extras.verdict) + "\n";
  return text;
}

/// The record, in the order of its fields. @param fields of YAML or JSON
template <typename Fields>
void addRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
               const RecordExtras& extras, Fields& fields) {
  const auto add_list = [](Fields& to, const char* name, const auto& items,
                           const auto& visit_item) {
    if (!items.empty()) to.list(name, items, visit_item);
  };
  fields({"file"}, file);
  if (!extras.channel.empty()) fields({"channel"}, extras.channel);
  visitScanFields(scan, fields);
  visitResultFields(scan, prediction, extras, fields);
  fields.map("roughness", [&](Fields& roughness) {
    visitRoughnessFields(prediction.roughness, roughness);
    if (isComputed(prediction.spatial_roughness))
      visitSpatialRoughnessFields(prediction.spatial_roughness, roughness);
  });
  if (extras.device_force) {
    fields.map("device_force",
               [&](Fields& force) { visitDeviceForceFields(*extras.device_force, force); });
  }
  fields.texts("warnings", extras.warnings);
  add_list(fields, "preprocessing", extras.preprocessing.steps, kVisitStep);
  if (hasTipStep(extras.preprocessing)) {
    fields({"tip_unreached_fraction"}, extras.preprocessing.tip_unreached_fraction);
  }
  add_list(fields, "convergence", extras.convergence, known(extras.formulation, kVisitRow));
  add_list(fields, "cleanings", extras.cleanings, kVisitCleaning);
  if (!extras.cleanings.empty()) {
    fields.map("cleaning_spread",
               [&](Fields& spread) { visitSpreadFields(spreadOf(extras.cleanings), spread); });
  }
  add_list(fields, "energy_curve", prediction.energy_curve, kVisitPoint);
  if (extras.has_curve) add_list(fields, "curve", prediction.curve, kVisitSeparationPoint);
  if (extras.half_space) {
    fields.map("half_space", [&](Fields& half_space) {
      visitHalfSpaceFields(*extras.half_space, half_space);
      visitHalfSpaceStiffness(*extras.half_space, half_space);
      add_list(half_space, "curve", curveOf(*extras.half_space), kVisitCurvePoint);
    });
  }
  if (extras.sweep) {
    fields.map("sweep", [&](Fields& sweep) {
      sweep({"pull_in_voltage", "V"}, extras.sweep->pull_in_voltage);
      if (!extras.sweep->pull_in_reason.empty())
        sweep({"pull_in_reason"}, extras.sweep->pull_in_reason);
      add_list(sweep, "summaries", extras.sweep->summaries, kVisitSummary);
      add_list(sweep, "points", extras.sweep->rows, known(extras.formulation, kVisitSweepRow));
    });
  }
}

}  // namespace

std::string yamlRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const RecordExtras& extras) {
  YAML::Emitter emitter;
  YamlFields fields(emitter);
  emitter << YAML::BeginDoc << YAML::BeginMap;
  addRecord(file, scan, prediction, extras, fields);
  emitter << YAML::EndMap;
  std::string text = std::string(emitter.c_str()) + "\n";
  text += summaryComment(prediction, extras);
  if (!extras.convergence.empty()) text += convergenceTable(extras.convergence, "# ");
  if (!extras.cleanings.empty()) text += cleaningTable(extras.cleanings, "# ");
  if (extras.sweep) text += sweepTable(*extras.sweep, "# ");
  return text;
}

std::string jsonRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const RecordExtras& extras) {
  nlohmann::json record;
  JsonFields fields(record);
  addRecord(file, scan, prediction, extras, fields);
  // A file name need not be UTF-8; a bad byte becomes U+FFFD instead of an exception.
  return record.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace mems_stiction
