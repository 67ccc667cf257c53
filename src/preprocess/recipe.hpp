#pragma once

/// @file
/// Which steps does a scan need that nobody has cleaned, and what do they change?
///
/// - level: always; robust where tall features would pull it aslant (tilt.hpp).
/// - lines: where rows jump. A jump lifts both halves of a row, roughness does not: the mean
/// product of the halves' median
///   differences from the row before is the variance of the jumps. Rows whose jumps have more than
///   0.1 of the levelled rms height are aligned, by medians of differences.
/// - spikes and fill: where pixels jump out of their surroundings, or are missing.
///
/// It takes as long as the cleaning that it tries.

#include <string>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline_options.hpp"

namespace mems_stiction {

/// The steps that a scan needs, and what of it they are for.
struct CleaningRecipe {
  PipelineOptions steps;            ///< to be switched on
  double rms_height = 0.0;          ///< as measured [m]
  double cleaned_rms_height = 0.0;  ///< [m]
  double line_jumps = 0.0;          ///< standard deviation from row to row [m]
  long long spikes = 0;             ///< pixels that jump out
  long long missing = 0;            ///< pixels without a height that it fills

  bool needsMoreThanAPlane() const;
  /// The settings to write, and what each does; without commas.
  std::string sentence() const;
};

/// @throw SurfaceError if no pixel is valid.
CleaningRecipe cleaningRecipe(const HeightMap& scan);

}  // namespace mems_stiction
