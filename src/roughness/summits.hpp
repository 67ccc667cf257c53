#pragma once

/// @file
/// The tops of a surface: how many, how blunt.
///
/// A summit is a valid pixel above its eight neighbours, all valid (of equal heights side by side,
/// the last in reading order). Its curvature is -(z_xx + z_yy)/2 by central differences at the
/// pixel. Summits at the frame's border or beside an invalid pixel cannot be told from slopes and
/// are left out, of the area too. Summits are those of this pitch: they are sound where the surface
/// is smooth over some pixels (about six per correlation length); noise of a pixel makes summits of
/// its own (low_pass.hpp). On a Gaussian surface with spectral moments m0, m2, m4 (Nayak 1971;
/// McCool, Wear 107 (1986) 37):
///     density = m4/(6 pi sqrt(3) m2),  mean curvature = (8/3) sqrt(m4/pi)

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Figures of the summits of one scan.
struct SummitParameters {
  int count = 0;
  double density = 0.0;         ///< summits per area of the pixels that were examined [1/m^2]
  double mean_curvature = 0.0;  ///< [1/m]; 0 without summits
  double mean_radius =
      0.0;  ///< 1/mean_curvature, as in Greenwood and Williamson's model [m]; 0 without summits
  double rms_height = 0.0;  ///< of the summits about their mean [m]
};

/// @throw SurfaceError if no pixel is valid.
SummitParameters summitParameters(const HeightMap& surface);

}  // namespace mems_stiction
