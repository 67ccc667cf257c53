#include "ros/prediction_conversion.hpp"

#include "errors/one_line.hpp"
#include "errors/short_number.hpp"
#include "numeric/words.hpp"
#include "prediction/prediction_fields.hpp"
#include "ros/message_fields.hpp"
#include "ros/message_parts.hpp"
#include "verdict/part_verdict_fields.hpp"
#include "verdict/regime_flags.hpp"
#include "verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace {

// The messages state the same numbers as the core's enumerations.
static_assert(static_cast<int>(Status::kEquilibrium) == StictionPrediction::EQUILIBRIUM, "status");
static_assert(static_cast<int>(Status::kBonded) == StictionPrediction::BONDED, "status");
static_assert(static_cast<int>(Status::kNoEquilibrium) == StictionPrediction::NO_EQUILIBRIUM,
              "status");
static_assert(static_cast<int>(BondingRegime::kBonding) == StictionPrediction::REGIME_BONDING,
              "bonding_regime");
static_assert(static_cast<int>(BondingRegime::kAdherence) == StictionPrediction::REGIME_ADHERENCE,
              "bonding_regime");
static_assert(static_cast<int>(BondingRegime::kNonBonding) ==
                  StictionPrediction::REGIME_NON_BONDING,
              "bonding_regime");
static_assert(static_cast<int>(ContactTheory::kDmt) == StictionPrediction::THEORY_DMT,
              "contact_theory");
static_assert(static_cast<int>(ContactTheory::kTransition) == StictionPrediction::THEORY_TRANSITION,
              "contact_theory");
static_assert(static_cast<int>(ContactTheory::kJkr) == StictionPrediction::THEORY_JKR,
              "contact_theory");
static_assert(static_cast<int>(Regime::kElastic) == AsperityContact::ELASTIC, "regime");
static_assert(static_cast<int>(Regime::kElastoPlastic) == AsperityContact::ELASTO_PLASTIC,
              "regime");
static_assert(static_cast<int>(Regime::kPlastic) == AsperityContact::PLASTIC, "regime");
static_assert(static_cast<int>(Sticks::kNo) == StictionPrediction::STICKS_NO, "sticks");
static_assert(static_cast<int>(Sticks::kMarginal) == StictionPrediction::STICKS_MARGINAL, "sticks");
static_assert(static_cast<int>(Sticks::kYes) == StictionPrediction::STICKS_YES, "sticks");
static_assert(static_cast<int>(Sticks::kUnknown) == StictionPrediction::STICKS_UNKNOWN, "sticks");
static_assert(static_cast<std::uint32_t>(kBondedFlag) == StictionPrediction::FLAG_BONDED,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kNoEquilibriumFlag) ==
                  StictionPrediction::FLAG_NO_EQUILIBRIUM,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kTaborFlag) == StictionPrediction::FLAG_TABOR,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kPlasticityFlag) == StictionPrediction::FLAG_PLASTICITY,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kResolutionFlag) == StictionPrediction::FLAG_RESOLUTION,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kFewContactsFlag) == StictionPrediction::FLAG_FEW_CONTACTS,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kNearBondingFlag) == StictionPrediction::FLAG_NEAR_BONDING,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kBorderFlag) == StictionPrediction::FLAG_BORDER,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kOnePixelFlag) == StictionPrediction::FLAG_ONE_PIXEL,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kUnresolvedFlag) == StictionPrediction::FLAG_UNRESOLVED,
              "regime_flags");

/// At most so many points of a curve; of a longer one, every other, fourth, ... and its largest
/// force.
constexpr std::size_t kMostCurvePoints = 512;

std::vector<SeparationPoint> curveMessage(const std::vector<SeparationCurvePoint>& curve) {
  const std::size_t every = (curve.size() + kMostCurvePoints - 2) / (kMostCurvePoints - 1);
  std::size_t largest = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].force > curve[largest].force) largest = i;
  }
  std::vector<SeparationPoint> points;
  MessageFields fields;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (i % every != 0 && i != largest) continue;
    SeparationPoint point;
    visitSeparationPointFields(curve[i], fields);
    fields.fill(point);
    points.push_back(point);
  }
  return points;
}

}  // namespace

StictionPrediction predictionMessage(const PredictedScan& scan, const std_msgs::Header& header) {
  const Prediction& prediction = scan.prediction;
  StictionPrediction message;
  message.header = header;
  MessageFields fields;
  visitPredictionFields(prediction, fields);
  fields.fill(message);
  visitRoughnessFields(prediction.roughness, fields);
  fields.fill(message.roughness);
  visitSpatialRoughnessFields(prediction.spatial_roughness, fields);
  fields.fill(message.spatial_roughness);
  visitVerdictFields(scan.verdict, fields);
  fields.fill(message);
  message.reason = withoutCommas(scan.verdict.reason);
  fillProvenance(scan.provenance, message);

  message.preprocessing = withoutCommas(recordLines(scan.preprocessing));
  message.tip_unreached_fraction = scan.preprocessing.tip_unreached_fraction;
  message.formulation = scan.formulation;
  message.warnings = withoutCommas(scan.warnings);
  message.flags = regimeFlagList(scan.verdict.regime_flags);
  message.model_doubt = modelDoubt(prediction);
  message.curve = curveMessage(prediction.curve);
  return message;
}

std::string summaryOf(const PredictedScan& scan) {
  const Prediction& prediction = scan.prediction;
  const Verdict& verdict = scan.verdict;
  std::string line = scan.provenance.scan_name + ": sticks " + sticksText(verdict.sticks) + " (" +
                     verdict.reason + "); pull-off force " +
                     shortNumber(prediction.pull_off_force) + " N";
  if (prediction.has_asperities)
    line += "; " + countText(static_cast<std::size_t>(prediction.asperity_count), "contact");
  for (const std::string& flag : regimeFlagList(verdict.regime_flags)) line += "; " + flag;
  for (const std::string& warning : scan.warnings) line += "; warning: " + warning;
  return oneLine(line);
}

PartVerdict partVerdictMessage(const PooledVerdict& part, const ScanOfPart& last) {
  PartVerdict message;
  message.header = last.header;
  message.version = last.provenance.version;
  message.settings_hash = last.pool_settings_hash;
  message.scan_name = last.provenance.scan_name;
  message.part_id = last.provenance.part_id;
  message.serial_id = last.provenance.serial_id;
  PooledVerdict governing = part;  // the message does not say which ratio governs
  if (part.governed_by == kGovernedByPeeling) governing.margin = {};
  if (part.governed_by == kGovernedByForce) governing.peel_number = {};
  MessageFields fields;
  visitPartVerdictFields(governing, fields);
  fields.fill(message);
  message.reason = withoutCommas(part.reason);
  message.flags = regimeFlagList(part.regime_flags);
  message.warnings = withoutCommas(part.warnings);
  return message;
}

AsperityArray asperitiesMessage(const Prediction& prediction, const std_msgs::Header& header) {
  AsperityArray message;
  message.header = header;
  message.asperities.reserve(prediction.asperities.size());
  MessageFields fields;
  for (const Asperity& asperity : prediction.asperities) {
    visitAsperityFields(asperity, fields);
    fields.fill(message.asperities.emplace_back());
  }
  return message;
}

}  // namespace mems_stiction
