#include "evaluation/device_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "device/device_force_fields.hpp"
#include "device/device_force_lists.hpp"
#include "errors/short_number.hpp"
#include "evaluation/record_fields.hpp"
#include "numeric/words.hpp"
#include "verdict/finding.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

const auto kVisitRealisation = [](const auto& item, auto&& fields) {
  visitRealisationFields(item, fields);
};
const auto kVisitPart = [](const auto& item, auto&& fields) {
  visitPartOfScanFields(item, fields);
};
const auto kVisitBand = [](const auto& item, auto&& fields) { visitBandFields(item, fields); };

/// The verdict's figures but for those of the device that the force has.
template <typename Fields>
void addVerdict(const Verdict& verdict, Fields& fields) {
  visitVerdictFields(verdict, [&](const Figure& figure, const auto& value) {
    const bool force_has_it = std::strcmp(figure.name, "device_apparent_work_of_adhesion") == 0 ||
                              startsWith(figure.name, "device_pull_off_force");
    if (!force_has_it) fields(figure, value);
  });
  fields({"regime_flag_names"}, regimeFlagNames(verdict.regime_flags));
}

/// The record, in the order of its fields. @param fields of YAML or JSON
template <typename Fields>
void addRecord(const DevicePrediction& prediction, Fields& fields) {
  const DeviceForce& force = prediction.force;
  fields.texts("scans", prediction.scans);
  std::vector<std::string> checksums;
  for (const ScanIdentity& identity : prediction.identities) checksums.push_back(identity.checksum);
  if (std::any_of(checksums.begin(), checksums.end(),
                  [](const std::string& text) { return !text.empty(); })) {
    fields.texts("scan_checksums", checksums);
  }
  if (!prediction.counter_surface.empty())
    fields.texts("counter_surface", prediction.counter_surface);
  if (prediction.provenance) visitStatedProvenance(*prediction.provenance, fields);
  fields({"formulation"}, prediction.formulation);
  visitDeviceForceFields(force, fields);
  if (prediction.verdict) addVerdict(*prediction.verdict, fields);
  fields.list("realisations", force.realisations, kVisitRealisation);
  fields.list("parts_of_scans", force.parts_of_scans, kVisitPart);
  fields.list("spectrum", force.spectrum, kVisitBand);
  fields.texts("warnings", prediction.warnings());
}

/// Force and verdict for people.
std::string summaryComment(const DevicePrediction& prediction) {
  const DeviceForce& force = prediction.force;
  std::string text = "# Pull-off force of " + shortNumber(force.area) + " m^2 " +
                     withInterval(force.pull_off_force, force.pull_off_force_lower,
                                  force.pull_off_force_upper, "N") +
                     "; the scans' force by area would say " +
                     shortNumber(force.linear_pull_off_force, 2) + " N";
  text += ".\n";
  if (prediction.verdict) text += "# " + verdictSentence(*prediction.verdict) + "\n";
  return text;
}

}  // namespace

std::string deviceYamlRecord(const DevicePrediction& prediction) {
  YAML::Emitter emitter;
  YamlFields fields(emitter);
  emitter << YAML::BeginDoc << YAML::BeginMap;
  addRecord(prediction, fields);
  emitter << YAML::EndMap;
  return std::string(emitter.c_str()) + "\n" + summaryComment(prediction);
}

std::string deviceJsonRecord(const DevicePrediction& prediction) {
  nlohmann::json record;
  JsonFields fields(record);
  addRecord(prediction, fields);
  return record.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace mems_stiction
