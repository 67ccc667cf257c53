#pragma once

/// @file
/// Do bonded surfaces close in the valleys of their relief, and what do they hold where they do not?
///
/// A valley that stays open is a crack in the interface. Pressed flat around it, the relief opens it with the tension
/// p_q = -(E/2)|q| h_q (relief_waves.hpp), and a round crack of radius a has the stress intensity (Sneddon 1946)
///
///     K(a) = 2/sqrt(pi a) integral of p r/sqrt(a^2 - r^2) dr = -E/sqrt(pi a) sum h_q sin(|q| a),
///
/// around each place; a pressure p0 takes 2 p0 sqrt(a/pi) from it. The valley closes as long as no crack reaches
/// K = sqrt(2 E Gamma) (Irwin 1957, between two bodies). Cracks that are not long against the cohesive length
/// l = E z0^2/Gamma do not count: it is the law that opens them, not their edge.
///
/// Surfaces with open valleys part from them, by Griffith's balance. In it E and z0 drop out but for the relief:
///
///     f = exp(-2 u) sqrt(E Gamma q),   u = U/Gamma,   q = 4 U/(E sigma^2)
///
/// U is the flattening energy per area, sigma the rms height, q the mean wave number that both tell of. The 2 is chosen on
/// frames of the half-space (doc/separation_evidence.md).

#include "numeric/constants.hpp"
#include "separation/relief_spectrum.hpp"

namespace mems_stiction {

/// Bonded bodies.
struct BondedBodies {
  double contact_modulus = 0.0;    ///< E [Pa], > 0
  double work_of_adhesion = 0.0;   ///< Gamma [J/m^2], > 0
  double range = 0.0;              ///< z0 [m]
  double flattening_energy = 0.0;  ///< U [J/m^2], > 0
  double rms_height = 0.0;         ///< sigma of the gap [m], > 0

  double cohesiveLength() const { return contact_modulus * range * range / work_of_adhesion; }
  /// a0, radius of the crack that needs as much by Irwin as an interface of this strength [Pa] does without one [m].
  double equalRadius(double strength) const {
    return 0.5 * kPi * contact_modulus * work_of_adhesion / (strength * strength);
  }
  /// Half a wave of the relief: beyond there is no more tension [m].
  double longestCrack() const { return kPi / waveNumber(); }
  /// Mean wave number of the relief [1/m].
  double waveNumber() const { return 4.0 * flattening_energy / (contact_modulus * rms_height * rms_height); }
};

/// Whether a crack of the relief's own stays open; no where the frame has no place for cracks that are long enough.
/// - @p relief in blocks no longer than half the cohesive length
/// - @p pressure that holds the bodies together [Pa], >= 0
bool valleysStayOpen(ReliefSpectrum& relief, const BondedBodies& bodies, double pressure);

/// Mean traction at which no place holds its crack any more, (S10e) [Pa]. A round crack of radius a needs
///
///     s/sqrt(1 + a/a0) - (tension of the long waves over it),   a0 = pi E Gamma/(2 s^2):
///
/// the strength s of an interface where it is short, Irwin's where it is long. It begins with no radius and has to grow, so a place
/// holds what its crack needs at most, and the weakest place counts.
/// - @p relief in blocks no longer than half the cohesive length
/// - @p strength s [Pa], > 0
/// - @p enough returned if cracks need more than that, or if half a wave is no longer than 2 a0: then nothing is a crack
double strengthAgainstCracks(ReliefSpectrum& relief, const BondedBodies& bodies, double strength, double enough);

/// f, the mean traction at which brittle surfaces with open valleys part [Pa].
double brittleStrength(const BondedBodies& bodies);

}  // namespace mems_stiction
