#pragma once

/// @file
/// What is left of a contact when the load that made it is taken back?
///
/// JKR's contacts do not open on the way back: each follows its stable branch down to its own
/// pull-off force. So, as long as the load presses, the set of contacts made under the largest load
/// so far stays:
///
///     - the approach, the cells in contact, sum R_i, and with them the pull-off force (11), F_w
///       and F_c, stay those of the largest load (the approach does not retreat; the elastic
///       retreat that is left out would let F_w fall a little, so what holds is an upper bound);
///     - F_e follows the square of voltage and contact potential together at that approach, F_m
///       follows the load, and the contacts share the new total in the same proportions;
///     - an elastic contact's radius follows (7) down its new share P0; what has flowed keeps its
///       radius: a^2 = chi a(P0)^2 + (1 - chi) a(largest)^2.
///
/// A solver that knows every load (ModelStatement) is asked again at each, for the surfaces as the
/// largest load has left them. What holds them, which flow and conforming have increased, stays
/// that of the largest load.
///
/// A load beyond the largest so far searches the equilibrium of the undeformed surfaces again:
/// loading passes the smaller states on its way, and their plastic flow is contained in that of the
/// larger. Should a search end at a smaller approach, the remaining contact stays.

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "station/measured_scan.hpp"

namespace mems_stiction {

/// The contact at one step of a loading path.
struct RemainingState {
  double voltage = 0.0;              ///< [V]
  double mechanical_load = 0.0;      ///< [N]
  double electrostatic_force = 0.0;  ///< at this voltage, with the contact potential [N]
  double lasting_field_share = 0.0;  ///< of that force: what stays without the voltage [-]
  double normal_load = 0.0;          ///< F_w + F_e + F_m + F_c [N]
  double contact_area =
      0.0;  ///< real area [m^2]; of the paper's formulations that of the largest load
  double contact_fraction = 0.0;  ///< of contact_area [-]
  double contact_area_jkr = 0.0;  ///< sum pi a_i^2 at this load [m^2]
  bool is_searched =
      false;  ///< the equilibrium was searched at this load; else the contact was held

  /// What of the field's force goes with the voltage [N].
  double voltageForce() const { return (1.0 - lasting_field_share) * electrostatic_force; }
};

/// A contact that was made, while loads change.
class RemainingContact {
 public:
  /// The surfaces are shared, not copied.
  /// - @p scan behind the surfaces
  RemainingContact(const Options& options, const SurfacePair& surfaces, MeasuredScan scan);
  /// Surfaces on the pixels that they were measured with.
  RemainingContact(const Options& options, const SurfacePair& surfaces);

  /// Goes on to the next load. @throw OptionsError if the load is out of range; then nothing
  /// changes.
  RemainingState advance(double voltage, double mechanical_load);

  /// That of the largest load so far. Only after advance().
  const Prediction& contact() const { return contact_; }

 private:
  Options options_;
  AdhesionModel model_;
  SurfacePair surfaces_;
  MeasuredScan scan_;
  bool has_contact_ = false;
  double largest_voltage_ = 0.0;  ///< in size [V]
  double largest_load_ = 0.0;     ///< [N]
  double field_factor_ =
      0.0;  ///< F_e/U^2 of the closest approach that was searched with a field [N/V^2]
  Prediction contact_;
  SurfacePair pressed_;  ///< the surfaces as that load has left them
};

}  // namespace mems_stiction
