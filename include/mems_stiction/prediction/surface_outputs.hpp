#pragma once

/// @file
/// The maps of a prediction: both surfaces after contact, and the deformation regime of every cell.

#include <cstdint>
#include <vector>

#include "mems_stiction/equilibrium/approach_search.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// What one patch does to its cells.
struct SurfaceChange {
  double lower_share = 0.0;  ///< of the interference that the lower surface gives way [-]
  double upper_share = 0.0;  ///< of the interference that the upper surface gives way [-]
  std::uint8_t regime = 0;   ///< as in the contact map
};

/// Kept from frame to frame, so that nothing is allocated.
struct SurfaceOutputMemory {
  std::vector<SurfaceChange> changes;  ///< in the order of the live patches
  std::vector<double> gaps;            ///< of one row
  std::vector<std::int32_t> columns;   ///< of its cells in contact
};

/// Fills those maps of `prediction` that options.output asks for.
/// - @p upper null for a flat counter-surface, whose own z is 0 everywhere before contact.
void fillSurfaceOutputs(const HeightMap& lower, const HeightMap* upper, const EquilibriumState& state,
                        ApproachSearch& search, const GapField& field, const AsperityLaw& law, const Options& options,
                        SurfaceOutputMemory& memory, Prediction& prediction);

}  // namespace mems_stiction
