#pragma once

/// @file
/// Which settings are allowed, but hardly meant? Constants that no material, device or instrument
/// is likely to have are slips of a unit: a modulus of 169 is 169 GPa, a hundred metres of
/// insulator are 100 nm. Settings that the solver at work does not use were meant for another one.
/// Fields that no insulator stands are no operating point.

#include <string>
#include <vector>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// The remarks on the file of the settings. Then one sentence for each stated constant outside what
/// is usual, with the unit that was probably meant; zeros say "not stated". Then one for each
/// setting that is not its default, but has no effect. Empty when all is well.
std::vector<std::string> settingsWarnings(const Configuration& configuration);

/// What only a frame tells: a sentence for a load that is more than the softer surface could carry
/// with all of its area, and those about fields.
/// - @p options that the prediction was made with
std::vector<std::string> frameWarnings(const Prediction& prediction, const Options& options,
                                       const DeviceOptions& device);

/// What looks wrong in a scan and in what it meets.
std::vector<std::string> warningsOf(const PreparedScan& prepared);

/// All that looks wrong around a prediction: in the scan and what it meets, in the settings, in the
/// load.
/// - @p options that the prediction was made with
std::vector<std::string> predictionWarnings(const PreparedScan& prepared,
                                            const Configuration& configuration,
                                            const Prediction& prediction, const Options& options);

}  // namespace mems_stiction
