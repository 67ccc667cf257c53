#pragma once

/// @file
/// What scans leave open of a device, and where they contradict each other, in sentences that name
/// the scan.

#include <string>
#include <vector>

#include "device/device_surface.hpp"
#include "mems_stiction/device/device_force.hpp"

namespace mems_stiction {

/// Long waves that no scan shows though the spectrum still rises towards them.
/// - @p side of a contact [m]
std::vector<std::string> missingLongWaves(const DeviceSurfaces& surfaces, const DeviceLaws& laws,
                                          double side);

/// The fine scan without which the force is not known, since none of the finest ones shows what
/// holds (verdict/missing_scan.hpp); empty if one does. Of a single scan in the words of its own
/// warning.
std::string missingShortWaves(const DeviceSurfaces& surfaces, const Options& model);

/// The fine scan without which contacts have too few pixels; empty if they have enough.
/// - @p pitch of the surfaces that are generated [m]
std::string missingPixels(const DeviceArea& area, double pitch);

/// Scans whose roughness differs from that of all others, at the same waves, by more than scatter.
std::vector<std::string> contradictions(const DeviceSurfaces& surfaces);

}  // namespace mems_stiction
