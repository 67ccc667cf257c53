#pragma once

/// @file
/// What does the field of the electrode add to what holds a beam that touches?
///
/// The beam has come down by h where it touches, and lies in one of the shapes of
/// beam_adhesion.hpp, of the arm s = l of a cantilever or s = l/2 of a doubly clamped beam, xi =
/// x/s from the clamp:
///
///     arc, a cantilever            phi = (3 xi^2 - xi^3)/2
///     S-shape, doubly clamped      phi = 3 xi^2 - 2 xi^3
///     gap at x                     d(x) = g + t_i/eps_i + d_c - h phi(x) - b psi(x)
///
/// with the mean gap d_c of the rough surfaces in contact. psi is what an even load on the
/// electrode adds to the shape of an arm while it stays where it touches, a cantilever as on a
/// bearing, the arms of a doubly clamped beam without a slope. Its b follows from the balance of
/// bending (and of the force N along a doubly clamped beam) with the field, as in
/// beam_electrode.hpp:
///
///     b [E I integral psi''^2 dx + N integral psi'^2 dx] = (1/2) eps0 w V^2 integral psi/d^2 dx
///     N = w t (sigma + (12/5) E h^2/l^2)
///
/// Where no b balances before more of the arm lies on the substrate the field alone holds the beam,
/// with more force than there is to open it: infinite here.
///
/// The co-energy of the field, (1/2) eps0 w V^2 integral dx/d over the electrode, changes with h
/// and with s, beside what adhesion brings:
///
///     force on what touches        (1/2) eps0 w V^2 integral phi/d^2 dx
///     work of what is peeled       (1/2) eps0 V^2 integral h xi phi'(xi)/(s d^2) dx, per arm
///
/// Assumptions: as beam_adhesion.hpp; no fringes. Against a finite-difference beam the force is
/// within 5 % (test/core/verdict/beam_electrode_test.cpp).

#include "verdict/beam_electrode.hpp"

namespace mems_stiction {

/// What holds a closed beam besides adhesion.
struct FieldHold {
  double force = 0.0;  ///< at what touches: what beamForce() has to overcome, too [N]
  double work =
      0.0;  ///< per area that is peeled: what peelNumber() has below its line, too [J/m^2]
};

/// - @p beam with a width and a type
/// - @p contact_gap d_c [m], >= 0; with the electrode's gaps > 0 where the beam touches above the
/// electrode
FieldHold fieldHold(const Beam& beam, const BeamElectrode& electrode, double voltage,
                    double contact_gap);

/// The same of a beam that is stuck flat beyond its S-shaped arms.
/// - @p unstuck_length of each arm, s [m], > 0
FieldHold stuckFieldHold(const Beam& beam, const BeamElectrode& electrode, double voltage,
                         double contact_gap, double unstuck_length);

}  // namespace mems_stiction
