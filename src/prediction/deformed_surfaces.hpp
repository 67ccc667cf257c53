#pragma once

/// @file
/// For whoever goes on with the surfaces after contact.

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// The same, with what goes on and no more: the surfaces, and the contacts for the verdict.
inline Options withDeformedSurfaces(Options options) {
  options.output.deformed_surfaces = true;
  options.output.asperities = true;
  options.output.contact_map = false;
  options.output.roughness = false;
  options.output.energy_curve = false;
  return options;
}

/// @throw SurfaceError if there are none: the solver does not give them.
inline void requireDeformedSurfaces(const Prediction& prediction) {
  if (!prediction.deformed_lower.empty() && !prediction.deformed_upper.empty()) return;
  throw SurfaceError("there are no surfaces after contact: this approach/formulation does not give them");
}

}  // namespace mems_stiction
