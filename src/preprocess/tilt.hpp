#pragma once

/// @file
/// Does a scan lie so aslant that its highest edge would touch, and not its summits?
///
/// By a sample of at most 64 x 64 pixels at equal distances, which costs a live scan nothing: a
/// tilt that matters takes most of the rms height, and a sample of thousands knows that to a
/// percent.
///
///     const Tilt tilt = tiltOf(scan);
///     if (tilt.isLarge()) warn(tilt.advice());

#include <string>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// What the least-squares plane takes of the rms height.
struct Tilt {
  double rms_height = 0.0;           ///< Sq of the sample [m]
  double levelled_rms_height = 0.0;  ///< the same less its plane [m]

  /// Less than half of the rms height is left without the plane.
  bool isLarge() const;
  /// What to do about it, and what that changes; without commas.
  std::string advice() const;
};

/// - @p scan of any size; with fewer than three valid pixels in the sample there is no tilt
Tilt tiltOf(const HeightMap& scan);

/// What a robust polynomial of degree 1 (tilt) or 2 (tilt and bow) would still take off.
struct TiltLeft {
  double rms_height = 0.0;  ///< of the polynomial over the sample [m]
  double noise = 0.0;       ///< of the ground that it is fitted to, as a standard deviation [m]
  double surface_rms_height = 0.0;  ///< Sq of the sample [m]

  /// More than the ground's own roughness, and no rounding of the surface.
  bool isLarge() const { return rms_height > noise && rms_height > 0.02 * surface_rms_height; }
  /// For a surface that was levelled by all pixels alike; without commas.
  std::string advice() const;
};

/// - @p levelled of any size, by the sample of tiltOf
TiltLeft tiltLeft(const HeightMap& levelled, int degree);

}  // namespace mems_stiction
