#pragma once

/// @file
/// What a solver is asked: two surfaces, the gap between them, and the settings.

#include "approach/gap_field.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Everything that it refers to outlives the call that it is given to.
struct ContactProblem {
  const SurfacePair& surfaces;
  const GapField& gap;  ///< of these surfaces; cells that are invalid in either never touch
  /// sigma = sqrt(sigma1^2 + sigma2^2) of the two surfaces [m]
  double composite_rms_height;
  const ContactSettings& settings;
};

}  // namespace mems_stiction
