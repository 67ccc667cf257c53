#pragma once

/// @file
/// What bends and stretches an arm between a clamp and a guide that is moved aside?
///
/// An arm of length s, half of a doubly clamped beam, is clamped at one end. Its other end moves
/// by h and keeps its slope of zero. Under the axial force N (tension positive, of residual stress
/// and stretching) its shape is that of a beam-column (Timoshenko and Gere, Theory of Elastic
/// Stability, 1961):
///
///     h = F/(N k) (k s - 2 tanh(k s/2)),   k = sqrt(N/(E I))       tan under compression
///     N = w t (sigma + E e),   e = 1/(2 s) integral over s of w'^2 dx
///
/// With z = (k s/2)^2 = N s^2/(4 E I), and r(z) from the continued fraction of the hyperbolic
/// tangent, which is that of the tangent for z < 0:
///
///     F = (4 E I h/s^3) (3 + z + r),   r = z/(5 + z/(7 + z/(9 + ...))) = z v/(v - tanh v) - z - 3,
///             v = sqrt(z)
///     integral of w'^2 dx = d(F h)/dN = (h^2/s) (1 + r'(z)),  by the theorem of the envelope
///     z = 3 sigma s^2/(E t^2) + (3/2) (h/t)^2 (1 + r'(z))
///
/// F h is the least of a sum that is linear in N, thus concave: r' falls from 1/2 at z = -pi^2 over
/// 1/5 at 0 to 0, and the last equation has one root. r is finite above z = -20.19, where F has a
/// pole. The energy per width, and what it loses when the arm grows while h and the material that
/// lies down stay:
///
///     U = (1/2) (F h - N integral of w'^2 dx)/w + s t (sigma e + E e^2/2)
///     G = -dU/ds = (E t^3 h^2/(2 s^4)) (3 + r - z r') + t (sigma e + (3/2) E e^2)
///
/// Assumptions: slender, small slopes, no shear.

#include "mems_stiction/verdict/beam_adhesion.hpp"

namespace mems_stiction {

/// The arm in its balance.
struct GuidedArm {
  double column = 0.0;   ///< z [-]
  double stretch = 0.0;  ///< e, by bending alone [-]
  double force = 0.0;    ///< F per width [N/m]
  double work = 0.0;     ///< G [J/m^2]
};

/// - @p beam its thickness, gap, modulus and residual stress
/// - @p length s [m], > 0
GuidedArm guidedArm(const Beam& beam, double length);

}  // namespace mems_stiction
