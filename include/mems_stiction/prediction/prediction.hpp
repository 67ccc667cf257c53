#pragma once

/// @file
/// The answer of the model for one pair of surfaces. What each figure is, with its unit:
/// prediction/prediction_fields.hpp, whose names are those of the messages and of the records that
/// predict_scan prints.
///
///     pull-off force    = largest attraction on retraction, without voltage and mechanical load
///     apparent work     = integral of the attraction on retraction from rest on, over the nominal
///                         area
///     contact fraction  = contact area/area of the valid cells
///     flattening ratio  = energy that presses the surfaces flat/what adhesion and water give:
///                         below 0.75 they may bond
///
/// Forces and areas are those of the scanned area, not of a device (device/device_force.hpp).
/// Assumptions stand with the solver that answered, and `model` says what holds of the figures.
/// Degenerate cases: NaN is a figure that the solver does not have; without equilibrium the forces
/// mean nothing; of bonded surfaces they may be lower bounds (isLowerBound()).
///
///     const Prediction prediction = model.predict(surfaces);  // adhesion_model.hpp
///     const bool is_sound = prediction.status == Status::kEquilibrium && !prediction.model.doubt;

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "mems_stiction/roughness/spatial_roughness.hpp"
#include "mems_stiction/roughness/unresolved_waves.hpp"

namespace mems_stiction {

/// Regime of the whole interface by the adhesion parameter (14); limits 1 and 12 by Gui et al.
/// 1999.
enum class BondingRegime : std::uint8_t {
  kBonding = 0,
  kAdherence = 1,
  kNonBonding = 2,
  kUnknown = 3
};

/// Which single-asperity theory the median Tabor parameter asks for (Johnson and Greenwood 1997):
/// JKR above 5, DMT below 0.1, the transition between.
enum class ContactTheory : std::uint8_t { kDmt = 0, kTransition = 1, kJkr = 2, kUnknown = 3 };

/// "BONDING", "ADHERENCE", "NON_BONDING", "UNKNOWN"
const char* word(BondingRegime regime);
/// "DMT", "TRANSITION", "JKR", "UNKNOWN"
const char* word(ContactTheory theory);

/// What a scan leaves out, against what adhesion bridges (verdict/missing_scan.hpp). NaN: not
/// known.
struct ShortWaves {
  UnresolvedWaves waves;
  double limit = std::numeric_limits<double>::quiet_NaN();         ///< of their rms height [m]
  double needed_pitch = std::numeric_limits<double>::quiet_NaN();  ///< of a scan that would show
                                                                   ///< what holds [m]; NaN: none

  bool areUnresolved() const { return waves.rms_height > limit; }
};

/// Everything that AdhesionModel::predict() finds out about one pair of surfaces.
struct Prediction {
  static constexpr double kUnknown = ContactSolution::kUnknown;

  Status status = Status::kNoEquilibrium;
  int steps = 0;

  double voltage = 0.0;
  double mechanical_load = 0.0;
  double van_der_waals_force = 0.0;
  double electrostatic_force = 0.0;
  double normal_load = 0.0;
  double capillary_force = 0.0;

  double pull_off_force = 0.0;
  double pull_off_force_jkr = 0.0;
  double pull_off_force_transition = 0.0;

  double contact_area = 0.0;
  double contact_area_jkr = 0.0;
  double nominal_area = 0.0;
  double contact_fraction = 0.0;
  double approach = 0.0;
  double mean_gap = 0.0;

  double mechanical_energy = 0.0;
  double surface_energy = 0.0;
  double elastic_energy = 0.0;
  double total_energy = 0.0;
  double plastic_work = 0.0;
  double bonding_energy = 0.0;
  double normalized_bonding_energy = 0.0;

  double apparent_work_of_adhesion = kUnknown;
  double contact_stiffness = kUnknown;
  double flattening_energy = kUnknown;
  double flattening_ratio = kUnknown;
  Exponents pull_off_exponents;  ///< of the pull-off force
  Exponents work_exponents;      ///< of the apparent work of adhesion
  bool is_conforming = false;
  bool is_bonded_by_load = false;  ///< bonded, but not without voltage and load

  double adhesion_parameter = 0.0;
  BondingRegime bonding_regime = BondingRegime::kNonBonding;
  bool has_asperities =
      true;  ///< false: the solver parts the contact into no asperities, and counts none
  int asperity_count = 0;
  int elastic_count = 0;
  int elasto_plastic_count = 0;
  int plastic_count = 0;
  int pull_off_contact_count = 0;
  double max_tilt = 0.0;
  double median_tabor_parameter = 0.0;
  ContactTheory contact_theory = ContactTheory::kTransition;

  double composite_rms_height = 0.0;
  double rms_height = 0.0;
  ArealParameters roughness;  ///< of the lower surface
  double invalid_fraction = 0.0;
  double processing_time = 0.0;

  ModelStatement model;  ///< what the solver says of these figures
  /// Whether the pull-off force is a lower bound: the search ended before the contacts stopped
  /// growing.
  bool isLowerBound() const;
  /// Whether `asperities` lists every contact: it does not if the solver knows none, or
  /// output/asperities is off.
  bool listsContacts() const;
  std::vector<Asperity> asperities;
  std::vector<Asperity> pull_off_contacts;  ///< that hold at the pull-off (contact_solution.hpp),
                                            ///< also with output/asperities off
  /// Those that a verdict rests on: at the pull-off, or at rest where the formulation knows no
  /// others.
  const std::vector<Asperity>& holdingContacts() const;
  /// Whether holdingContacts() lists every one of them.
  bool listsHoldingContacts() const;
  std::vector<EnergyPoint> energy_curve;
  std::vector<SeparationCurvePoint>
      curve;               ///< force over displacement; empty if the formulation does not follow it
  cv::Mat deformed_lower;  ///< rows x cols CV_64FC1 [m], NaN where invalid
  cv::Mat deformed_upper;  ///< the same in the upper surface's own z [m]
  cv::Mat contact_map;     ///< rows x cols CV_8UC1, values of Regime
  cv::Mat pressure;  ///< rows x cols CV_64FC1 [Pa], repulsion positive; empty if the solver does
                     ///< not know it

  double median_contact_pixels = 0.0;
  double median_composite_radius = 0.0;
  bool is_resolution_limited = false;
  bool is_tip_limited = false;
  double tip_limit = std::numeric_limits<double>::quiet_NaN();
  int below_tip_count = -1;
  ShortWaves short_waves;              ///< of the scan
  SpatialRoughness spatial_roughness;  ///< of the scan; NaN unless output/spatial_roughness is set
};

}  // namespace mems_stiction
