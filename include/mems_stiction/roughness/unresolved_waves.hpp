#pragma once

/// @file
/// How high are the waves that a scan cannot show, since they are shorter than two pixels or drawn
/// by the tip?
///
/// They are continued from the shortest ones that it does show. Differences of fourth order over
/// five places of a line, t apart, let waves of about 2 t pass:
///
///     D(t) = <(h(-2t) - 4 h(-t) + 6 h(0) - 4 h(t) + h(2t))^2>
///     D(t) = A/(2 pi) I(H) S(H) t^(2H)                 of a self-affine surface, C = A q^(-2 - 2H)
///     S(H) = 2 (56 - 28 2^(2H) + 8 3^(2H) - 4^(2H)),
///             I(H) = Gamma(1 - H)/(2^(2H + 1) H Gamma(1 + H))
///     <h^2> of waves shorter than l = A (2 pi/l)^(-2H)/(4 pi H)
///
/// with t = l and 2 l, so that both lie among what is shown, H by their ratio and A by their
/// geometric mean. H is kept within 1/2 and 1: a spectrum that falls faster ends above l, as one of
/// a smooth surface does, and is continued as slowly as a self-affine one may; one that falls more
/// slowly has not begun to fall. Lines along both axes count alike. Of the squares the largest
/// tenth is left out, as of a Gaussian surface: steps, particles and scratches are no waves.
/// (Self-affine spectra: Persson, J. Chem. Phys. 115 (2001) 3840. The sums follow from the
/// variogram r^(2H).)
///
///     const UnresolvedWaves waves = unresolvedWaves(scan, {}, 5e-9);  // against a plane

#include <limits>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// NaN: the frame is too small to tell, or the surfaces do not fit on each other.
struct UnresolvedWaves {
  double pitch = std::numeric_limits<double>::quiet_NaN();  ///< the longer one of the scan [m]
  double shortest_shown = std::numeric_limits<double>::quiet_NaN();  ///< l [m]
  double rms_height = std::numeric_limits<double>::quiet_NaN();      ///< of shorter waves [m]
  double hurst = std::numeric_limits<double>::quiet_NaN();  ///< H that they are continued with [-]
};

/// - @p lower, upper the relief is the lower one less the upper one; an empty upper one is a plane
/// - @p least_wave shorter ones are the tip's [m]; NaN or 0: no tip is known
UnresolvedWaves unresolvedWaves(const HeightMap& lower, const HeightMap& upper, double least_wave);

}  // namespace mems_stiction
