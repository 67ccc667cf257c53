#pragma once

/// @file
/// What pulls two surfaces together across a gap: van der Waals attraction and the field of a
/// voltage; and when does a spring-held plate give way to the field?
///
///     van der Waals, plates:   p = H/(6 pi d^3)                              (2)
///     electrostatic, plates:   p = eps0 U^2/(2 (d + t/eps_r)^2)              (3); in contact d = 0
///     pull-in:                 U = sqrt(8 k (g + t/eps_r)^3/(27 eps0 A))
///
/// Assumptions: smooth parallel plates much wider than their gap (no fringes); no retardation, so
/// gaps below some 10 nm for van der Waals and an overestimate beyond; an insulator without charge
/// in it; for pull-in a linear spring and a travel of more than a third of (g + t/eps_r). Outside:
/// all diverge as the gap closes without an insulator. The caller keeps van der Waals gaps at an
/// interatomic cut-off (about 0.165 nm) or more; a field gap of 0 without insulator is a short
/// circuit and gives infinity. Sources: Israelachvili, Intermolecular and Surface Forces (3rd ed.,
/// 2011), chapter 13; Deladi et al. 2002, (2) and (3), the insulator's thickness there without
/// eps_r; Senturia, Microsystem Design (2001), chapter 6.
///
///     const double pull = cell_area * surface_forces::vanDerWaalsPressure(gap, hamaker_constant);
///
/// Pressures are published positive when they attract. Arguments throughout: gap d [m], > 0;
/// hamaker_constant H [J]; voltage U [V]; insulator_thickness t [m], >= 0;
/// insulator_relative_permittivity eps_r [-], >= 1.

namespace mems_stiction {
namespace surface_forces {

/// p of parallel plates [Pa].
double vanDerWaalsPressure(double gap, double hamaker_constant);

/// U/(d + t/eps_r), the field in the gap of such electrodes [V/m]; in the insulator it is 1/eps_r
/// of that, so that in contact the whole voltage lies over it.
double gapField(double gap, double voltage, double insulator_thickness,
                double insulator_relative_permittivity);

/// p of parallel electrodes with an insulator on one of them [Pa]. gap = 0 is contact, gap < 0
/// counts as contact.
double electrostaticPressure(double gap, double voltage, double insulator_thickness,
                             double insulator_relative_permittivity);

/// Voltage above which a plate on a linear spring has no stable position before contact [V].
/// - @p spring_constant k [N/m], > 0
/// - @p rest_gap g, the gap without voltage [m], > 0
/// - @p electrode_area A [m^2], > 0
double pullInVoltage(double spring_constant, double rest_gap, double electrode_area,
                     double insulator_thickness = 0.0,
                     double insulator_relative_permittivity = 1.0);

}  // namespace surface_forces
}  // namespace mems_stiction
