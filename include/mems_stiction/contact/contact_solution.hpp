#pragma once

/// @file
/// What a solver answers, whichever it is: the state at rest, and what it takes to leave that
/// state. The figures and maps of a Prediction follow from it. Equations: doc/separation_curve.md,
/// doc/theory.md.
///
///     load.total()  = F_w + F_e + F_m + F_c, which the contacts carry at rest
///     energies      : (8) of the paper, total = mechanical + surface - elastic
///
/// Assumptions are the solver's own; `model` states them. Degenerate cases: a figure that a solver
/// does not have is NaN, a map that it does not have, or that was not asked for, is empty, and
/// `has_asperities` says whether it parts the contact into asperities at all. With the status
/// kNoEquilibrium the figures are those of the last step.
///
///     const bool is_at_rest = solution.status != Status::kNoEquilibrium;
///     const double adhesion = is_at_rest ? solution.pull_off_force : 0.0;  // [N]

#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/contact/model_statement.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"

namespace mems_stiction {

/// The total normal load on the contacts, as a sum with named parts (section 2.1 of the paper).
struct NormalLoad {
  double van_der_waals = 0.0;  ///< F_w [N]
  double electrostatic = 0.0;  ///< F_e [N]
  double mechanical = 0.0;     ///< F_m [N]
  double capillary =
      0.0;  ///< F_c, of condensed water; 0 unless interface/relative_humidity is set [N]

  double total() const { return van_der_waals + electrostatic + mechanical + capillary; }
};

/// How the search for the place of rest ended.
enum class Status : std::uint8_t {
  kEquilibrium = 0,  ///< the contacts carry the loads: the surfaces rest
  kBonded = 1,  ///< the surfaces conform, or overlap over approach/max_contact_fraction before they
                ///< rest; forces are lower bounds where ModelStatement::is_bound_where_bonded
  kNoEquilibrium = 2,  ///< the search range ended first: results are those of the last step
};

/// "EQUILIBRIUM", "BONDED", "NO_EQUILIBRIUM"
const char* word(Status status);

/// One step of the approach, for the energy curve.
struct EnergyPoint {
  double approach = 0.0;           ///< D [m]
  double contact_fraction = 0.0;   ///< [-]
  double normal_load = 0.0;        ///< F [N]
  double carried_load = 0.0;       ///< what the contacts can carry [N]
  double generalized_force = 0.0;  ///< dE_t/dD [N]
  double mechanical_energy = 0.0;  ///< (10.1) [J]
  double surface_energy = 0.0;     ///< (10.1) [J]
  double elastic_energy = 0.0;     ///< (10.2) [J]
  double total_energy = 0.0;       ///< (8) [J]
};

/// One point of the force between the surfaces over their displacement.
struct SeparationCurvePoint {
  double displacement = 0.0;   ///< D of the upper surface past first touch, below zero apart [m]
  double force = 0.0;          ///< attraction positive [N]
  bool is_separation = false;  ///< of the unloading branch, where it is another: summits are soft,
                               ///< or have flowed, or conform
};

/// One contact at equilibrium.
struct Asperity {
  double x = 0.0, y = 0.0,
         z = 0.0;  ///< centre: col pitch_x, row pitch_y, height of the lower surface [m]
  double cap_radius =
      0.0;  ///< of a disc as large as the overlap; of the paper rc, of the caps' base [m]
  double composite_radius = 0.0;  ///< of the gap; of the paper R_i of (5) [m]
  double load = 0.0;              ///< F_i of (6) [N]
  double contact_radius = 0.0;    ///< of a disc of the real area; of the paper a of JKR (7) [m]
  double tilt = 0.0;              ///< of the paper theta, else NaN [rad]
  double plasticity_index = 0.0;  ///< phi of (9) [-]
  double tabor_parameter = 0.0;   ///< mu [-]
  double area = 0.0;              ///< real; of the paper that of the cells in contact [m^2]
  bool is_at_border = false;      ///< reaches the frame's border: its summit may lie outside
  Regime regime = Regime::kElastic;
};

/// With which powers a figure goes with the constants, each changed alone: d ln(figure)/d
/// ln(constant) [-].
struct Exponents {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double adhesion = kUnknown;      ///< with the work of adhesion
  double modulus = kUnknown;       ///< with the contact modulus
  double hamaker = kUnknown;       ///< with the Hamaker constant
  double contact_potential = 0.0;  ///< with the contact potential
};

/// The energies of a contact.
struct ContactEnergies {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double mechanical = kUnknown;    ///< of the load [J]
  double surface = kUnknown;       ///< of the surfaces that touch [J]
  double elastic = kUnknown;       ///< stored in the bodies [J]
  double plastic_work = kUnknown;  ///< dissipated in flow along the approach [J]

  /// (8): mechanical + surface - elastic [J]
  double total() const { return mechanical + surface - elastic; }
};

/// The state that a solver has found, and what it takes to leave it.
struct ContactSolution {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  Status status = Status::kNoEquilibrium;
  int steps = 0;                   ///< that the solver took
  ModelStatement model;            ///< what holds of these figures
  double approach = kUnknown;      ///< D from first touch [m]
  double mean_gap = kUnknown;      ///< over the cells out of contact [m]; 0 when every cell touches
  double contact_area = kUnknown;  ///< real area of contact [m^2]
  double contact_fraction = kUnknown;  ///< the same over the area of the valid cells [-]
  NormalLoad load;                     ///< what presses the surfaces together, by its causes
  ContactEnergies energies;

  double pull_off_force = kUnknown;      ///< [N]
  double pull_off_force_jkr = kUnknown;  ///< the part of the contacts by JKR [N]
  double pull_off_force_transition =
      kUnknown;  ///< the same with the JKR-DMT transition's prefactors [N]
  double apparent_work_of_adhesion = kUnknown;  ///< of drawing the surfaces apart, per area [J/m^2]
  double contact_stiffness = kUnknown;          ///< -dF/dD at rest [N/m]
  double flattening_energy =
      kUnknown;                  ///< that pressing the surfaces flat would store, per area [J/m^2]
  Exponents pull_off_exponents;  ///< of the pull-off force
  Exponents work_exponents;      ///< of the apparent work of adhesion
  bool is_conforming = false;    ///< the surfaces lie against each other nearly everywhere
  bool is_bonded_by_load =
      false;  ///< bonded, but without the loads they would have come to rest before
  double contact_area_jkr = kUnknown;    ///< sum pi a_i^2 [m^2]
  double adhesion_parameter = kUnknown;  ///< (14) [-]; infinite without work of adhesion

  bool has_asperities = false;  ///< false: `asperities` is empty because the solver knows none
  std::vector<Asperity> asperities;
  /// Those that hold at the pull-off, which the load that made the contact does not choose: centre,
  /// composite_radius, area, tabor_parameter, is_at_border and regime. Empty if they are those at
  /// rest.
  std::vector<Asperity> pull_off_contacts;
  std::vector<EnergyPoint> energy_curve;  ///< if output.energy_curve asks for it
  std::vector<SeparationCurvePoint>
      curve;  ///< force over displacement; empty if the solver does not follow it

  // Maps, rows x cols of the frame, if `output` asks for them.
  cv::Mat contact_map;      ///< CV_8UC1, values of Regime
  cv::Mat displaced_lower;  ///< CV_64FC1 [m], NaN where invalid: the lower surface after contact
  cv::Mat displaced_upper;  ///< the same in the upper surface's own z
  cv::Mat pressure;  ///< CV_64FC1 [Pa], repulsion positive; empty if the solver does not know it

  /// As new, but with the memory of lists and maps, which are there to be written over.
  void clear();
};

}  // namespace mems_stiction
