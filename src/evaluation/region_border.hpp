#pragma once

/// @file
/// What a region of interest changes about the figures of a prediction.

#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// Contacts that reach pixels outside the region count as those at the frame's border: their summits may lie there.
/// Pixels outside are no missing ones: invalid_fraction is that of the region.
/// - @p prepared with a region
void countRegionAlone(const PreparedScan& prepared, Prediction& prediction);

}  // namespace mems_stiction
