#pragma once

/// @file
/// The maps of a prediction: both surfaces after contact, and the deformation regime of every cell.

#include "mems_stiction/equilibrium/approach_search.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// Fills those maps of `prediction` that options.output asks for.
/// - @p upper null for a flat counter-surface, whose own z is 0 everywhere before contact.
void fillSurfaceOutputs(const HeightMap& lower, const HeightMap* upper, const EquilibriumState& state,
                        ApproachSearch& search, const GapField& field, const GapOrder& order, const AsperityLaw& law,
                        const Options& options, Prediction& prediction);

}  // namespace mems_stiction
