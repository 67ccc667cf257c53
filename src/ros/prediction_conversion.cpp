#include "mems_stiction/ros/prediction_conversion.hpp"

#include <algorithm>
#include <utility>

#include "mems_stiction/ros/message_text.hpp"
#include "mems_stiction/ros/provenance_conversion.hpp"
#include "mems_stiction/verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

// The messages state the same numbers as the core's enumerations.
static_assert(static_cast<int>(Status::kEquilibrium) == StictionPrediction::EQUILIBRIUM, "status");
static_assert(static_cast<int>(Status::kBonded) == StictionPrediction::BONDED, "status");
static_assert(static_cast<int>(Status::kNoEquilibrium) == StictionPrediction::NO_EQUILIBRIUM, "status");
static_assert(static_cast<int>(BondingRegime::kBonding) == StictionPrediction::REGIME_BONDING, "bonding_regime");
static_assert(static_cast<int>(BondingRegime::kAdherence) == StictionPrediction::REGIME_ADHERENCE, "bonding_regime");
static_assert(static_cast<int>(BondingRegime::kNonBonding) == StictionPrediction::REGIME_NON_BONDING, "bonding_regime");
static_assert(static_cast<int>(ContactTheory::kDmt) == StictionPrediction::THEORY_DMT, "contact_theory");
static_assert(static_cast<int>(ContactTheory::kTransition) == StictionPrediction::THEORY_TRANSITION, "contact_theory");
static_assert(static_cast<int>(ContactTheory::kJkr) == StictionPrediction::THEORY_JKR, "contact_theory");
static_assert(static_cast<int>(Regime::kElastic) == AsperityContact::ELASTIC, "regime");
static_assert(static_cast<int>(Regime::kElastoPlastic) == AsperityContact::ELASTO_PLASTIC, "regime");
static_assert(static_cast<int>(Regime::kPlastic) == AsperityContact::PLASTIC, "regime");
static_assert(static_cast<int>(Sticks::kNo) == StictionPrediction::STICKS_NO, "sticks");
static_assert(static_cast<int>(Sticks::kMarginal) == StictionPrediction::STICKS_MARGINAL, "sticks");
static_assert(static_cast<int>(Sticks::kYes) == StictionPrediction::STICKS_YES, "sticks");
static_assert(static_cast<int>(Sticks::kUnknown) == StictionPrediction::STICKS_UNKNOWN, "sticks");
static_assert(static_cast<std::uint32_t>(kBondedFlag) == StictionPrediction::FLAG_BONDED, "regime_flags");
static_assert(static_cast<std::uint32_t>(kNoEquilibriumFlag) == StictionPrediction::FLAG_NO_EQUILIBRIUM,
              "regime_flags");
static_assert(static_cast<std::uint32_t>(kTaborFlag) == StictionPrediction::FLAG_TABOR, "regime_flags");
static_assert(static_cast<std::uint32_t>(kPlasticityFlag) == StictionPrediction::FLAG_PLASTICITY, "regime_flags");
static_assert(static_cast<std::uint32_t>(kResolutionFlag) == StictionPrediction::FLAG_RESOLUTION, "regime_flags");
static_assert(static_cast<std::uint32_t>(kFewContactsFlag) == StictionPrediction::FLAG_FEW_CONTACTS, "regime_flags");
static_assert(static_cast<std::uint32_t>(kNearBondingFlag) == StictionPrediction::FLAG_NEAR_BONDING, "regime_flags");
static_assert(static_cast<std::uint32_t>(kBorderFlag) == StictionPrediction::FLAG_BORDER, "regime_flags");
static_assert(static_cast<std::uint32_t>(kOnePixelFlag) == StictionPrediction::FLAG_ONE_PIXEL, "regime_flags");

std::uint32_t count(int value) { return static_cast<std::uint32_t>(value); }

RoughnessStatistics roughnessMessage(const ArealParameters& parameters) {
  RoughnessStatistics message;
  message.sa = parameters.sa;
  message.sq = parameters.sq;
  message.ssk = parameters.ssk;
  message.sku = parameters.sku;
  message.sp = parameters.sp;
  message.sv = parameters.sv;
  message.sz = parameters.sz;
  message.sdq = parameters.sdq;
  message.sdr = parameters.sdr;
  return message;
}

SpatialRoughnessStatistics spatialRoughnessMessage(const SpatialRoughness& roughness) {
  SpatialRoughnessStatistics message;
  message.sal = roughness.sal;
  message.str = roughness.str;
  message.m0 = roughness.m0;
  message.m2 = roughness.m2;
  message.m4 = roughness.m4;
  message.nayak = roughness.nayak;
  message.summit_density = roughness.summit_density;
  message.mean_summit_radius = roughness.mean_summit_radius;
  message.hurst = roughness.hurst;
  return message;
}

void fillVerdict(const Verdict& verdict, StictionPrediction& message) {
  message.sticks = static_cast<std::uint8_t>(verdict.sticks);
  message.reason = withoutCommas(verdict.reason);
  message.restoring_force = verdict.restoring_force;
  message.device_pull_off_force = verdict.device_pull_off_force;
  message.margin = verdict.margin;
  message.margin_lower = verdict.margin_lower;
  message.margin_upper = verdict.margin_upper;
  message.margin_uncertainty = verdict.margin_uncertainty;
  message.margin_transition = verdict.margin_transition;
  message.apparent_work_of_adhesion = verdict.apparent_work_of_adhesion;
  message.peel_number = verdict.peel_number;
  message.peel_number_lower = verdict.peel_number_lower;
  message.peel_number_upper = verdict.peel_number_upper;
  message.detachment_length = verdict.detachment_length;
  message.unstuck_length = verdict.unstuck_length;
  message.pull_in_voltage = verdict.pull_in_voltage;
  message.regime_flags = verdict.regime_flags;
}

/// At most so many points of a curve; of a longer one, every other, fourth, ... and its largest force.
constexpr std::size_t kMostCurvePoints = 512;

std::vector<SeparationPoint> curveMessage(const std::vector<SeparationCurvePoint>& curve) {
  const std::size_t every = (curve.size() + kMostCurvePoints - 2) / (kMostCurvePoints - 1);
  std::size_t largest = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].force > curve[largest].force) largest = i;
  }
  std::vector<SeparationPoint> points;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (i % every != 0 && i != largest) continue;
    SeparationPoint point;
    point.displacement = curve[i].displacement;
    point.force = curve[i].force;
    point.is_separation = static_cast<std::uint8_t>(curve[i].is_separation);
    points.push_back(point);
  }
  return points;
}

AsperityContact contactMessage(const Asperity& asperity) {
  AsperityContact message;
  message.x = asperity.x;
  message.y = asperity.y;
  message.z = asperity.z;
  message.cap_radius = asperity.cap_radius;
  message.composite_radius = asperity.composite_radius;
  message.load = asperity.load;
  message.contact_radius = asperity.contact_radius;
  message.tilt = asperity.tilt;
  message.plasticity_index = asperity.plasticity_index;
  message.tabor_parameter = asperity.tabor_parameter;
  message.area = asperity.area;
  message.regime = static_cast<std::uint8_t>(asperity.regime);
  return message;
}

}  // namespace

StictionPrediction predictionMessage(const PredictedScan& scan, const std_msgs::Header& header) {
  const Prediction& prediction = scan.prediction;
  StictionPrediction message;
  message.header = header;
  message.status = static_cast<std::uint8_t>(prediction.status);
  message.steps = count(prediction.steps);

  message.voltage = prediction.voltage;
  message.mechanical_load = prediction.mechanical_load;
  message.van_der_waals_force = prediction.van_der_waals_force;
  message.electrostatic_force = prediction.electrostatic_force;
  message.normal_load = prediction.normal_load;

  message.pull_off_force = prediction.pull_off_force;
  message.pull_off_force_jkr = prediction.pull_off_force_jkr;
  message.pull_off_force_transition = prediction.pull_off_force_transition;

  message.contact_area = prediction.contact_area;
  message.contact_area_jkr = prediction.contact_area_jkr;
  message.nominal_area = prediction.nominal_area;
  message.contact_fraction = prediction.contact_fraction;
  message.approach = prediction.approach;
  message.mean_gap = prediction.mean_gap;

  message.mechanical_energy = prediction.mechanical_energy;
  message.surface_energy = prediction.surface_energy;
  message.elastic_energy = prediction.elastic_energy;
  message.total_energy = prediction.total_energy;
  message.plastic_work = prediction.plastic_work;
  message.bonding_energy = prediction.bonding_energy;
  message.normalized_bonding_energy = prediction.normalized_bonding_energy;

  message.adhesion_parameter = prediction.adhesion_parameter;
  message.bonding_regime = static_cast<std::uint8_t>(prediction.bonding_regime);
  message.asperity_count = count(prediction.asperity_count);
  message.elastic_count = count(prediction.elastic_count);
  message.elasto_plastic_count = count(prediction.elasto_plastic_count);
  message.plastic_count = count(prediction.plastic_count);
  message.max_tilt = prediction.max_tilt;
  message.median_tabor_parameter = prediction.median_tabor_parameter;
  message.contact_theory = static_cast<std::uint8_t>(prediction.contact_theory);

  message.composite_rms_height = prediction.composite_rms_height;
  message.rms_height = prediction.rms_height;
  message.roughness = roughnessMessage(prediction.roughness);
  message.invalid_fraction = prediction.invalid_fraction;
  message.processing_time = prediction.processing_time;
  message.capillary_force = prediction.capillary_force;
  message.spatial_roughness = spatialRoughnessMessage(prediction.spatial_roughness);
  message.median_contact_pixels = prediction.median_contact_pixels;
  message.median_composite_radius = prediction.median_composite_radius;
  message.is_resolution_limited = static_cast<std::uint8_t>(prediction.is_resolution_limited);
  message.is_tip_limited = static_cast<std::uint8_t>(prediction.is_tip_limited);

  message.preprocessing = withoutCommas(recordLines(scan.preprocessing));
  message.tip_unreached_fraction = scan.preprocessing.tip_unreached_fraction;
  fillVerdict(scan.verdict, message);
  message.formulation = scan.formulation;
  message.warnings = withoutCommas(scan.warnings);
  message.flags = regimeFlagList(scan.verdict.regime_flags);
  fillProvenance(scan.provenance, message);
  message.contact_stiffness = prediction.contact_stiffness;
  message.flattening_energy = prediction.flattening_energy;
  message.flattening_ratio = prediction.flattening_ratio;
  message.adhesion_exponent = prediction.pull_off_exponents.adhesion;
  message.modulus_exponent = prediction.pull_off_exponents.modulus;
  message.is_conforming = static_cast<std::uint8_t>(prediction.is_conforming);
  message.curve = curveMessage(prediction.curve);
  message.pull_off_contact_count = prediction.pull_off_contact_count;
  return message;
}

AsperityArray asperitiesMessage(const Prediction& prediction, const std_msgs::Header& header) {
  AsperityArray message;
  message.header = header;
  message.asperities.reserve(prediction.asperities.size());
  for (const Asperity& asperity : prediction.asperities) message.asperities.push_back(contactMessage(asperity));
  return message;
}

}  // namespace mems_stiction
