#pragma once

/// @file
/// Is the scan fine enough for what is read off it?
///
/// Two things end the resolution of a scan: its pixels and the tip that drew it. A contact of few
/// pixels has a radius that hangs on where the grid lies; a tip of radius r shows no summit sharper
/// than r. Neither can be seen in the pull-off force itself, so the prediction carries a flag for
/// each.
///
///     Prediction prediction = model.predict(scan);
///     flagResolution(12.0, 20e-9, prediction);  // tip of 20 nm
///     if (prediction.is_tip_limited) report("the tip is too blunt");

#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Limits of the two flags.
struct ResolutionOptions {
  double min_contact_pixels =
      12.0;  ///< pixels of the scan that the median contact should span [-], >= 0; 0 = no flag
  double tip_radius = 0.0;  ///< radius of the tip that drew the scan [m], >= 0; 0 = that of
                            ///< preprocessing/tip, if any

  void describe(OptionVisitor& visitor);
};

/// Sets is_resolution_limited and is_tip_limited from median_contact_pixels and
/// median_composite_radius. Without contact neither is set.
/// - @p tip_radius [m]; 0 = not known
void flagResolution(double min_contact_pixels, double tip_radius, Prediction& prediction);

/// Sets tip_limit, and below_tip_count by the contacts that hold at the pull-off.
/// - @p tip_limit [m]; NaN = not known
void countBelowTip(double tip_limit, Prediction& prediction);

}  // namespace mems_stiction
