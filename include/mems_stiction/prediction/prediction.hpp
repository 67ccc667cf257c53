#pragma once

/// @file
/// The answer of the model for one pair of surfaces. Field names are those of msg/StictionPrediction.msg and of the
/// records that predict_scan prints.

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "mems_stiction/roughness/spatial_roughness.hpp"

namespace mems_stiction {

/// Regime of the whole interface by the adhesion parameter (14); limits 1 and 12 by Gui et al. 1999.
enum class BondingRegime : std::uint8_t { kBonding = 0, kAdherence = 1, kNonBonding = 2, kUnknown = 3 };

/// Which single-asperity theory the median Tabor parameter asks for (Johnson and Greenwood 1997): JKR above 5, DMT
/// below 0.1, the transition between.
enum class ContactTheory : std::uint8_t { kDmt = 0, kTransition = 1, kJkr = 2, kUnknown = 3 };

/// Everything that AdhesionModel::predict() finds out about one pair of surfaces.
struct Prediction {
  static constexpr double kUnknown = ContactSolution::kUnknown;

  Status status = Status::kNoEquilibrium;
  int steps = 0;  ///< steps of the approach that were taken

  double voltage = 0.0;              ///< U [V]
  double mechanical_load = 0.0;      ///< F_m [N]
  double van_der_waals_force = 0.0;  ///< F_w of (2) [N]
  double electrostatic_force = 0.0;  ///< F_e of (3) [N]
  double normal_load = 0.0;          ///< F = F_w + F_e + F_m + F_c [N]
  double capillary_force = 0.0;      ///< F_c of condensed water; 0 unless interface/relative_humidity is set [N]

  /// Largest force while the surfaces are drawn apart, after voltage and load have gone; of the paper's formulations (11): pull_off_force_jkr +
  /// van_der_waals_force + capillary_force [N]
  double pull_off_force = 0.0;
  double pull_off_force_jkr = 0.0;         ///< (3/2) pi Gamma sum R_i [N]
  double pull_off_force_transition = 0.0;  ///< the same sum with the JKR-DMT transition's prefactor of each contact [N]

  double contact_area = 0.0;      ///< real area of contact; of the paper's formulations all cells that overlap [m^2]
  double contact_area_jkr = 0.0;  ///< sum pi a_i^2 [m^2]
  double nominal_area = 0.0;      ///< valid cells [m^2]
  double contact_fraction = 0.0;  ///< contact_area / nominal_area [-]
  double approach = 0.0;          ///< D from first touch [m]
  double mean_gap = 0.0;          ///< mean of the gap over the cells out of contact [m]

  double mechanical_energy = 0.0;          ///< E_m of (10.1) [J]
  double surface_energy = 0.0;             ///< E_s of (10.1) [J]
  double elastic_energy = 0.0;             ///< E_e of (10.2) [J]
  double total_energy = 0.0;               ///< E_t of (8) [J]
  double plastic_work = 0.0;               ///< dissipated in flow along the approach [J]
  double bonding_energy = 0.0;             ///< E_t / nominal area [J/m^2]
  double normalized_bonding_energy = 0.0;  ///< bonding_energy / Gamma [-]; NaN when Gamma = 0

  double apparent_work_of_adhesion = kUnknown;  ///< of drawing the surfaces apart, per nominal area [J/m^2]
  double contact_stiffness = kUnknown;          ///< -dF/dD at rest [N/m]
  double flattening_energy = kUnknown;          ///< that pressing the surfaces flat would store, per area [J/m^2]
  double flattening_ratio = kUnknown;           ///< flattening_energy/Gamma [-]
  Exponents pull_off_exponents;                 ///< of the pull-off force
  Exponents work_exponents;                     ///< of the apparent work of adhesion
  bool is_conforming = false;                   ///< flattening costs less than adhesion gives: flat nearly everywhere
  bool is_bonded_by_load = false;               ///< bonded, but not without voltage and load
  /// Largest rise of the force on the way in, without loads, after it has fallen: of its largest value [-]
  double joining_rise = 0.0;

  double adhesion_parameter = 0.0;  ///< (14) [-]; infinite when Gamma = 0
  BondingRegime bonding_regime = BondingRegime::kNonBonding;
  bool has_asperities = true;  ///< false: the solver parts the contact into no asperities, and counts none
  int asperity_count = 0;
  int elastic_count = 0;
  int elasto_plastic_count = 0;
  int plastic_count = 0;
  int pull_off_contact_count =
      0;                  ///< contacts that hold at the pull-off: what the load presses beside them does not count
  double max_tilt = 0.0;  ///< [rad]
  /// [-]; infinite when adhesion has no range (interface/hamaker_constant 0), NaN without contact
  double median_tabor_parameter = 0.0;
  ContactTheory contact_theory = ContactTheory::kTransition;

  double composite_rms_height = 0.0;  ///< sigma of (9): sqrt(sigma1^2 + sigma2^2) [m]
  double rms_height = 0.0;            ///< Sq of the lower surface [m]
  ArealParameters roughness;          ///< of the lower surface
  double invalid_fraction = 0.0;      ///< share of pixels that are invalid in either surface [-]
  double processing_time = 0.0;       ///< wall time of this prediction, its preparation included [s]

  ModelStatement model;  ///< what the solver says of these figures
  /// Whether the pull-off force is a lower bound: the search ended before the contacts stopped growing.
  bool isLowerBound() const { return status == Status::kBonded && model.is_bound_where_bonded; }
  /// Whether `asperities` lists every contact: it does not if the solver knows none, or output/asperities is off.
  bool listsContacts() const { return has_asperities && static_cast<int>(asperities.size()) == asperity_count; }
  std::vector<Asperity> asperities;
  std::vector<Asperity>
      pull_off_contacts;  ///< that hold at the pull-off (contact_solution.hpp), also with output/asperities off
  /// Those that a verdict rests on: at the pull-off, or at rest where the formulation knows no others.
  const std::vector<Asperity>& holdingContacts() const {
    return pull_off_contacts.empty() ? asperities : pull_off_contacts;
  }
  std::vector<EnergyPoint> energy_curve;
  std::vector<SeparationCurvePoint> curve;  ///< force over displacement; empty if the formulation does not follow it
  cv::Mat deformed_lower;                   ///< rows x cols CV_64FC1 [m], NaN where invalid
  cv::Mat deformed_upper;                   ///< the same in the upper surface's own z [m]
  cv::Mat contact_map;                      ///< rows x cols CV_8UC1, values of Regime
  cv::Mat pressure;  ///< rows x cols CV_64FC1 [Pa], repulsion positive; empty if the solver does not know it

  double median_contact_pixels = 0.0;  ///< pixels of the scan in half of the contacts or fewer [-]; NaN without contact
  double median_composite_radius = 0.0;  ///< median of R_i of (5) [m]; NaN without contact
  bool is_resolution_limited = false;    ///< median_contact_pixels is below resolution/min_contact_pixels
  bool is_tip_limited = false;           ///< the tip is blunter than the contacts: its radius > median_composite_radius
  SpatialRoughness spatial_roughness;    ///< of the scan; NaN unless output/spatial_roughness is set
};

}  // namespace mems_stiction
