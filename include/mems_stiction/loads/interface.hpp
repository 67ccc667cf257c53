#pragma once

/// @file
/// What acts between the two bodies: adhesion, van der Waals attraction, the insulator; and what is
/// applied to them.

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// The interface of the pair. Sources of the defaults: doc/theory.md, "Materials".
struct InterfaceOptions {
  double work_of_adhesion = 0.05;  ///< Gamma, thermodynamic, of the flat interface [J/m^2], >= 0
  double hamaker_constant =
      65e-21;  ///< H across the gap's medium [J], >= 0 (SiO2 across air: Bergstrom 1997)
  double equilibrium_distance = 0.2e-9;  ///< z0 of Tabor's parameter [m], > 0
  double insulator_thickness = 0.0;      ///< t [m], >= 0; must be > 0 when the voltage is not 0
  double insulator_relative_permittivity = 3.9;  ///< eps_r [-], >= 1 (thermal SiO2)
  double hardness_ratio_limit =
      0.9;  ///< a of (12): beyond a H1 <= H2 <= H1/a only the softer body deforms, in (0, 1)

  void describe(OptionVisitor& visitor);
};

/// What the outside applies.
struct LoadOptions {
  double voltage = 0.0;  ///< U [V], |U| <= max_voltage
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
  /// In place of whatever pressed before [N].
  void setMechanicalLoad(double newtons) {
    mechanical_load = newtons;
    pressure = device_force = 0.0;
  }
};

}  // namespace mems_stiction
