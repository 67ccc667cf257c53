#pragma once

/// @file
/// What acts between the two bodies: adhesion, van der Waals attraction, the insulator; and what is
/// applied to them.
///
///     InterfaceOptions interface;
///     interface.insulator_thickness = 100e-9;  // [m]: without it no voltage may be set
///     LoadOptions load;
///     load.voltage = 20.0;  // [V]

#include <cmath>

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// The interface of the pair. Sources of the defaults: config/stiction.yaml.
struct InterfaceOptions {
  double work_of_adhesion = 0.05;    ///< Gamma, thermodynamic, of the flat interface [J/m^2], >= 0
  double hamaker_constant = 65e-21;  ///< H across the gap's medium, of films where bodies have them
                                     ///< [J], >= 0 (SiO2 across air: Bergstrom 1997)
  double retardation_length = 0.0;   ///< lambda, gap that halves the attraction [m], >= 0; 0 = none
  double equilibrium_distance = 0.2e-9;  ///< z0 of Tabor's parameter [m], > 0
  double insulator_thickness = 0.0;      ///< t [m], >= 0; must be > 0 when anything makes a field
  double insulator_relative_permittivity = 3.9;  ///< eps_r [-], >= 1 (thermal SiO2)
  double hardness_ratio_limit =
      0.9;  ///< a of (12): beyond a H1 <= H2 <= H1/a only the softer body deforms, in (0, 1)

  void describe(OptionVisitor& visitor);
};

/// What the outside applies, and the potential between the surfaces that nobody takes away.
///
/// Contact potentials and trapped charge have a sign of their own, which is seldom known and may
/// change from part to part: with a voltage they count as if both had the same sign, which is the
/// worse case. The field is that of U + V_c as long as the voltage is on, and of V_c on the way
/// out.
struct LoadOptions {
  /// Largest contact potential, and potential of trapped charge, that is taken for one [V].
  static constexpr double kMostContactPotential = 50.0;

  double voltage = 0.0;  ///< U [V], |U| <= max_voltage
  double contact_potential =
      0.0;  ///< V_c, stays when the loads have gone [V]; its sign is no matter
  double mechanical_load =
      0.0;                ///< F_m, pressing, on the scanned area [N], in [0, max_mechanical_load]
  double pressure = 0.0;  ///< instead of it: pressing, per nominal area [Pa], >= 0
  double device_force = 0.0;    ///< instead of both: pressing the whole device together [N], >= 0
  double max_voltage = 1000.0;  ///< [V], > 0
  double max_mechanical_load = 1.0;  ///< [N], > 0

  void describe(OptionVisitor& visitor);

  /// Whether the load is stated by what is to be scaled to a frame; models take a mechanical_load
  /// alone.
  bool isPerArea() const { return pressure > 0.0 || device_force > 0.0; }
  /// |U| + |V_c|: whose field acts while the loads are on [V].
  double fieldVoltage() const { return std::abs(voltage) + std::abs(contact_potential); }
  /// What is left of that field's pressure when the voltage has gone [-]; 0 without a contact
  /// potential.
  double lastingFieldShare() const {
    if (contact_potential == 0.0) return 0.0;
    const double share = std::abs(contact_potential) / fieldVoltage();
    return share * share;
  }
  /// Whether anything presses the surfaces together beside their adhesion and a load per area.
  bool presses() const { return mechanical_load > 0.0 || fieldVoltage() != 0.0; }
  /// In place of whatever pressed before [N].
  void setMechanicalLoad(double newtons) {
    mechanical_load = newtons;
    pressure = device_force = 0.0;
  }
  /// A share of a stated load; one below every load that may be stated is none.
  void setShareOfLoad(double newtons) {
    setMechanicalLoad(newtons < Range::kSmallest ? 0.0 : newtons);
  }
};

}  // namespace mems_stiction
