#pragma once

/// @file
/// Constants that are allowed, but that no material, device or instrument is likely to have: slips of a unit. A modulus of
/// 169 is 169 GPa, a hundred metres of insulator are 100 nm.

#include <string>
#include <vector>

#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/scan/configuration.hpp"

namespace mems_stiction {

/// One sentence for each stated constant outside what is usual, with the unit that was probably meant; empty when all is
/// well. Zeros say "not stated".
std::vector<std::string> settingsWarnings(const Configuration& configuration);

/// The same of the load on a frame: one sentence if it is more than the softer surface could carry with all of its area.
/// - @p options that the prediction was made with
std::vector<std::string> loadWarnings(const Prediction& prediction, const Options& options);

}  // namespace mems_stiction
