#pragma once

/// @file
/// A load that is stated for the device, or per area, as what presses one frame together:
///
///     mechanical load of the frame = pressure x nominal area of the frame
///     pressure                     = device force/contact area of the device

#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/verdict/device_options.hpp"

namespace mems_stiction {

/// Cells that are valid in both surfaces [m^2].
double nominalArea(const SurfacePair& surfaces);

/// The options with the load of this frame as load.mechanical_load, and neither pressure nor device
/// force.
/// @throw SurfaceError if that is more than load/max_mechanical_load.
Options onFrame(const Options& options, const DeviceOptions& device, const SurfacePair& surfaces);

}  // namespace mems_stiction
