#pragma once

/// @file
/// What should a user know of a cleaning that was done as the settings say, but hardly as they
/// mean?

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"

namespace mems_stiction {

/// Whether there is a relief to compare a tilt with: not in what is smoothed to nothing, or too
/// small.
bool hasRelief(const HeightMap& cleaned, const PipelineOptions& cleaning);

/// That all roughness has gone; that tall features have pulled the levelling aslant, which leaves
/// their ground tilted.
/// - @p scan as measured; @p cleaned what became of it by `cleaning`
std::vector<std::string> cleaningWarnings(const HeightMap& scan, const HeightMap& cleaned,
                                          const PipelineOptions& cleaning);

}  // namespace mems_stiction
