#pragma once

/// @file
/// What of a prediction is asked for: figures and verdict alone, or the surfaces after contact,
/// too.

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// What figures and verdict need: the contacts.
inline OutputOptions figuresAlone() {
  OutputOptions output;
  output.deformed_surfaces = output.contact_map = output.roughness = output.energy_curve = false;
  return output;
}

/// The same, with what goes on and no more: the surfaces, and the contacts for the verdict.
inline Options withDeformedSurfaces(Options options) {
  options.output = figuresAlone();
  options.output.deformed_surfaces = true;
  return options;
}

/// @throw SurfaceError if there are none: the solver does not give them.
inline void requireDeformedSurfaces(const Prediction& prediction) {
  if (!prediction.deformed_lower.empty() && !prediction.deformed_upper.empty()) return;
  throw SurfaceError(
      "there are no surfaces after contact: this approach/formulation does not give them");
}

}  // namespace mems_stiction
