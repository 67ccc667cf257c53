#pragma once

/// @file
/// One table of the figures of a Prediction: name, member, unit. The records of predict_scan and the rows of
/// stiction_batch visit it, so a name or a unit stands in one place. Names are those of msg/StictionPrediction.msg;
/// messages are filled field by field (ros/prediction_conversion.hpp), and a test compares both.
///
///     visitPredictionFields(prediction, [&](const char* name, const auto& value, const char* unit) { print(...); });
///
/// Values are double, int, bool, Status, BondingRegime and ContactTheory; word() makes words of the enumerations.

#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// "EQUILIBRIUM", "BONDED", "NO_EQUILIBRIUM"
inline const char* word(Status status) {
  switch (status) {
    case Status::kEquilibrium:
      return "EQUILIBRIUM";
    case Status::kBonded:
      return "BONDED";
    case Status::kNoEquilibrium:
      break;
  }
  return "NO_EQUILIBRIUM";
}

/// "APART", "ELASTIC", "ELASTO_PLASTIC", "PLASTIC"
inline const char* word(Regime regime) {
  switch (regime) {
    case Regime::kApart:
      return "APART";
    case Regime::kElastic:
      return "ELASTIC";
    case Regime::kElastoPlastic:
      return "ELASTO_PLASTIC";
    case Regime::kPlastic:
      break;
  }
  return "PLASTIC";
}

/// "BONDING", "ADHERENCE", "NON_BONDING", "UNKNOWN"
inline const char* word(BondingRegime regime) {
  switch (regime) {
    case BondingRegime::kBonding:
      return "BONDING";
    case BondingRegime::kAdherence:
      return "ADHERENCE";
    case BondingRegime::kNonBonding:
      return "NON_BONDING";
    case BondingRegime::kUnknown:
      break;
  }
  return "UNKNOWN";
}

/// "DMT", "TRANSITION", "JKR", "UNKNOWN"
inline const char* word(ContactTheory theory) {
  switch (theory) {
    case ContactTheory::kDmt:
      return "DMT";
    case ContactTheory::kTransition:
      return "TRANSITION";
    case ContactTheory::kJkr:
      return "JKR";
    case ContactTheory::kUnknown:
      break;
  }
  return "UNKNOWN";
}

/// @param roughness ArealParameters, const or not
/// @param visit called with (name, value, unit) for each figure
template <typename Parameters, typename Visitor>
void visitRoughnessFields(Parameters& roughness, Visitor&& visit) {
  visit("sa", roughness.sa, "m");
  visit("sq", roughness.sq, "m");
  visit("ssk", roughness.ssk, "");
  visit("sku", roughness.sku, "");
  visit("sp", roughness.sp, "m");
  visit("sv", roughness.sv, "m");
  visit("sz", roughness.sz, "m");
  visit("sdq", roughness.sdq, "");
  visit("sdr", roughness.sdr, "");
}

/// @param roughness SpatialRoughness, const or not
/// @param visit called with (name, value, unit) for each figure
template <typename Parameters, typename Visitor>
void visitSpatialRoughnessFields(Parameters& roughness, Visitor&& visit) {
  visit("sal", roughness.sal, "m");
  visit("str", roughness.str, "");
  visit("m0", roughness.m0, "m^2");
  visit("m2", roughness.m2, "");
  visit("m4", roughness.m4, "1/m^2");
  visit("nayak", roughness.nayak, "");
  visit("summit_density", roughness.summit_density, "1/m^2");
  visit("mean_summit_radius", roughness.mean_summit_radius, "m");
  visit("hurst", roughness.hurst, "");
}

/// Every scalar of the prediction; the roughness figures have visitRoughnessFields() and visitSpatialRoughnessFields().
/// @param prediction Prediction, const or not
/// @param visit called with (name, value, unit) for each figure
template <typename PredictionType, typename Visitor>
void visitPredictionFields(PredictionType& prediction, Visitor&& visit) {
  visit("status", prediction.status, "");
  visit("steps", prediction.steps, "");

  visit("voltage", prediction.voltage, "V");
  visit("mechanical_load", prediction.mechanical_load, "N");
  visit("van_der_waals_force", prediction.van_der_waals_force, "N");
  visit("electrostatic_force", prediction.electrostatic_force, "N");
  visit("normal_load", prediction.normal_load, "N");
  visit("capillary_force", prediction.capillary_force, "N");

  visit("pull_off_force", prediction.pull_off_force, "N");
  visit("pull_off_force_jkr", prediction.pull_off_force_jkr, "N");
  visit("pull_off_force_transition", prediction.pull_off_force_transition, "N");

  visit("contact_area", prediction.contact_area, "m^2");
  visit("contact_area_jkr", prediction.contact_area_jkr, "m^2");
  visit("nominal_area", prediction.nominal_area, "m^2");
  visit("contact_fraction", prediction.contact_fraction, "");
  visit("approach", prediction.approach, "m");
  visit("mean_gap", prediction.mean_gap, "m");

  visit("mechanical_energy", prediction.mechanical_energy, "J");
  visit("surface_energy", prediction.surface_energy, "J");
  visit("elastic_energy", prediction.elastic_energy, "J");
  visit("total_energy", prediction.total_energy, "J");
  visit("plastic_work", prediction.plastic_work, "J");
  visit("bonding_energy", prediction.bonding_energy, "J/m^2");
  visit("normalized_bonding_energy", prediction.normalized_bonding_energy, "");

  visit("apparent_work_of_adhesion", prediction.apparent_work_of_adhesion, "J/m^2");
  visit("contact_stiffness", prediction.contact_stiffness, "N/m");
  visit("flattening_energy", prediction.flattening_energy, "J/m^2");
  visit("flattening_ratio", prediction.flattening_ratio, "");
  visit("adhesion_exponent", prediction.pull_off_exponents.adhesion, "");
  visit("modulus_exponent", prediction.pull_off_exponents.modulus, "");
  visit("is_conforming", prediction.is_conforming, "");
  visit("adhesion_parameter", prediction.adhesion_parameter, "");
  visit("bonding_regime", prediction.bonding_regime, "");
  visit("asperity_count", prediction.asperity_count, "");
  visit("elastic_count", prediction.elastic_count, "");
  visit("elasto_plastic_count", prediction.elasto_plastic_count, "");
  visit("plastic_count", prediction.plastic_count, "");
  visit("max_tilt", prediction.max_tilt, "rad");
  visit("median_tabor_parameter", prediction.median_tabor_parameter, "");
  visit("contact_theory", prediction.contact_theory, "");

  visit("composite_rms_height", prediction.composite_rms_height, "m");
  visit("rms_height", prediction.rms_height, "m");
  visit("invalid_fraction", prediction.invalid_fraction, "");
  visit("processing_time", prediction.processing_time, "s");

  visit("median_contact_pixels", prediction.median_contact_pixels, "");
  visit("median_composite_radius", prediction.median_composite_radius, "m");
  visit("is_resolution_limited", prediction.is_resolution_limited, "");
  visit("is_tip_limited", prediction.is_tip_limited, "");
  visit("pull_off_contact_count", prediction.pull_off_contact_count, "");
}

/// The fields of one point of the energy curve.
template <typename Point, typename Visitor>
void visitEnergyPointFields(Point& point, Visitor&& visit) {
  visit("approach", point.approach, "m");
  visit("contact_fraction", point.contact_fraction, "");
  visit("normal_load", point.normal_load, "N");
  visit("carried_load", point.carried_load, "N");
  visit("generalized_force", point.generalized_force, "N");
  visit("mechanical_energy", point.mechanical_energy, "J");
  visit("surface_energy", point.surface_energy, "J");
  visit("elastic_energy", point.elastic_energy, "J");
  visit("total_energy", point.total_energy, "J");
}

/// The fields of one point of the curve.
template <typename Point, typename Visitor>
void visitSeparationPointFields(Point& point, Visitor&& visit) {
  visit("displacement", point.displacement, "m");
  visit("force", point.force, "N");
  visit("is_separation", point.is_separation, "");
}

}  // namespace mems_stiction
