#pragma once

/// @file
/// Below which length does a scan show the tip that drew it?
///
/// A tip of radius R draws no summit sharper than itself. Over a stencil of three pixels of a row,
/// d apart,
///
///     c(d) = min over the frame of (h(x - d) - 2 h(x) + h(x + d))/d^2
///
/// is the sharpest summit at the scale 2 d. Where c(d) < -1/(2R) the tip has a part in it; the
/// largest such 2 d is the limit (Sanner, Nöhring, Thimons, Jacobs and Pastewka, Appl. Surf. Sci.
/// Adv. 7 (2022) 100190, who found the factor 1/2 on made surfaces). Rows only: from one row to the
/// next an instrument's drift bends as well.
///
///     const double limit = tipLimit(scan, 20e-9);
///
/// Degenerate cases: 0 where no scale is that sharp, the width where even a quarter of it is.
/// Frames of fewer than 8 columns, and those without three valid pixels in a row, know none: NaN.

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// - @p tip_radius [m], > 0
/// @return [m]
double tipLimit(const HeightMap& surface, double tip_radius);

}  // namespace mems_stiction
