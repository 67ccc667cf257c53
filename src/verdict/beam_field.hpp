#pragma once

/// @file
/// What does the field of the electrode add to what holds a beam that touches?
///
/// The beam has come down by h where it touches: the arm s = l of a cantilever with its tip, each
/// arm s = l/2 of a doubly clamped beam flat. The arm bends further under the field, by Ritz's
/// method (bent_beam.hpp), with the gap
///
///     d(x) = g + t_i/eps_i + d_c - w(x)
///
/// and the mean gap d_c of the rough surfaces in contact. Where nothing balances the field before
/// more of the arm lies on the substrate the field alone holds the beam, with more force than there
/// is to open it: infinite here.
///
/// The energy U(h, s) of arm and field together says what has to hold the arm, and what peels it:
///
///     F_e = F(V = 0) - F(V),   F(V) = dU/dh
///     G_e = G(V = 0) - G(V),   G(V) = -dU/ds per width and arm
///
/// To first order in V^2 that is the change of the co-energy (1/2) eps0 w V^2 integral dx/d of the
/// arm without a field.
///
/// Assumptions: as beam_adhesion.hpp; no fringes. Against a finite-difference beam the force is
/// within 2 % (test/core/verdict/beam_electrode_test.cpp).

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
