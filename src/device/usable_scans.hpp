#pragma once

/// @file
/// What of the scans that were given does the force of a device come from, and what is to be said
/// about them?
///
/// Scans stand in an order of their own (comesBefore()): that in which they were given tells
/// nothing. A scan that is there twice has been measured once. Pixels that are missing are filled
/// where every pixel is needed (roughness/filled_surface.hpp); the frames themselves are predicted
/// with their holes.

#include <string>
#include <vector>

#include "mems_stiction/device/device_force.hpp"

namespace mems_stiction {

/// Each scan once, and remarks that name the scan.
struct UsableScans {
  DeviceSurfaces surfaces;
  std::vector<std::string> remarks;
};

/// @throw SurfaceError with the name of a scan of which too little was measured
UsableScans usableScans(const DeviceSurfaces& surfaces);

}  // namespace mems_stiction
