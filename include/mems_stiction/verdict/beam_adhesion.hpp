#pragma once

/// @file
/// Does a beam that touches the substrate come off by itself, and how long may it be?
///
/// A beam of length l, thickness t and modulus E hangs over a gap h. Bending it down to the
/// substrate stores energy U(s) in each free arm of length s, and the arm peels until -dU/ds is the
/// apparent work of adhesion G, per width:
///
///     S-shape, flat on the substrate beyond s:    U = E t^3 h^2/(2 s^3),   G = (3/2) E t^3 h^2/s^4
///     arc, a cantilever that touches with its tip:  U = E t^3 h^2/(8 s^3),
///             G = (3/8) E t^3 h^2/s^4
///     S-shape of a doubly clamped beam, stretched: exact, as a beam-column, by guided_arm.hpp;
///         G = (3/2) E t^3 h^2/s^4 [1 + (9/25) (h/t)^2 + (2/5) sigma s^2/(E t^2)]
///         while the bracket is near 1
///
/// The peel number is G of the last shape before release over the real G: below 1 the beam stays
/// stuck.
///
///     cantilever (arc, s = l):      N = 3 E t^3 h^2/(8 G l^4)
///     doubly clamped (S, s = l/2):  N = 24 E t^3 h^2/(G l^4), times the bracket
///
/// Assumptions: slender beam of constant section, small slopes, no shear, a stiff substrate and
/// rigid clamps, and what is stuck does not slide. sigma is the residual stress, tensile positive;
/// a beam that buckles (bucklingStress()) is out of range. Sources: de Boer and
/// Michalske, J. Appl. Phys. 86 (1999) 817 for the shapes; Mastrangelo and Hsu, J. MEMS 2 (1993) 33
/// and 44 for the peel number and the idea of the doubly clamped form. That form is derived here
/// from the clamped-guided arm: the trial shape of one polynomial, u = 16 h x^2 (l -
/// x)^2/l^4, gives 128/5 in place of 24, the prefactor that goes by their names (recalled; their
/// papers were not read here).
///
///     if (peelNumber(beam, apparent_work) < 1.0) stuck();
///
/// Arguments throughout: work = G [J/m^2], >= 0: of the *rough* interface, per nominal area. 0
/// gives infinite peel numbers and lengths.

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

enum class BeamType { kNone, kCantilever, kDoublyClamped };

/// A beam over a substrate.
struct Beam {
  BeamType type = BeamType::kNone;
  double length = 0.0;           ///< l [m], > 0
  double thickness = 0.0;        ///< t [m], > 0
  double gap = 0.0;              ///< h [m], > 0
  double modulus = 0.0;          ///< E [Pa], > 0
  double residual_stress = 0.0;  ///< sigma, tensile positive [Pa]; of doubly clamped beams only
  double width = 0.0;            ///< w [m]; 0 = not stated
};

/// G at which an S-shaped arm rests with the unstuck length s [J/m^2]. @p unstuck_length s [m], > 0
double sShapeWork(const Beam& beam, double unstuck_length);

/// G at which a cantilever that touches with its tip only is about to come off, l = s [J/m^2].
double arcWork(const Beam& beam, double unstuck_length);

/// The residual stress below which a doubly clamped beam is not straight [Pa], < 0; -infinity for
/// others (Timoshenko and Gere, Theory of Elastic Stability, 1961: clamped ends).
///
///     -pi^2 E t^2/(3 l^2)
double bucklingStress(const Beam& beam);

/// N [-]; NaN for BeamType::kNone.
double peelNumber(const Beam& beam, double work);

/// Longest beam of this section and gap that comes off by itself: the length at which the peel
/// number is 1 [m]. NaN for BeamType::kNone.
double detachmentLength(const Beam& beam, double work);

/// Where the arm of a stuck beam rests: the s of the S-shape [m], of each arm when doubly clamped.
/// A beam shorter than that (twice that) cannot hold an S-shape. NaN for BeamType::kNone.
double unstuckLength(const Beam& beam, double work);

/// What pulls where the beam touches, its gap closed: at the tip of a cantilever, in the middle of
/// a doubly clamped beam, by dU/dh of the shapes above [N]. 0 without a width; NaN for
/// BeamType::kNone.
///
///     cantilever          F = E w t^3 h/(4 l^3)
///     doubly clamped      F = 2 F_arm(l/2) by guided_arm.hpp; 16 E w t^3 h/l^3 of small gaps
double beamForce(const Beam& beam);

/// How far along the beam adhesion gives way at one time, before what lies behind takes part of the
/// load [m]: half the decay length of a beam on an elastic foundation (Hetenyi, Beams on Elastic
/// Foundation, 1946) that fails at the pressure p after it has taken the work G, since its end then
/// carries p times that length. A contact that reaches less far is pulled open as a whole, and its
/// force decides; one that reaches further is peeled, and its work does.
///
///     (1/2) (2 E t^3 G/(3 p^2))^(1/4)
///
/// - @p pressure pull-off force over nominal area [Pa], > 0
double peelLength(const Beam& beam, double work, double pressure);

}  // namespace mems_stiction
