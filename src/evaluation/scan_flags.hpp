#pragma once

/// @file
/// What of a prediction is the scan's own, where the model has the scan on finer pixels or with
/// more than is to be judged: waves that the scan does not show, contacts at the border of its
/// region, the share of its missing pixels.

#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "station/measured_scan.hpp"

namespace mems_stiction {

/// Contacts from the model's pixels to those of the scan.
void bringContactsToScan(const PreparedScan& prepared, Prediction& prediction);

/// - @p waves of prepared.short_waves, under the settings of the prediction
/// - @p prediction its contacts on the pixels of the scan
void flagByScan(const PreparedScan& prepared, const ShortWaves& waves, Prediction& prediction);

/// Both, for contacts of prepared.model_surfaces, and the pixels that were measured.
MeasuredScan measuredScan(const PreparedScan& prepared, const Options& options);

}  // namespace mems_stiction
