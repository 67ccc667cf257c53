#pragma once

/// @file
/// From which length on is the contact of thin bodies a mosaic of places that rest each on their
/// own summits?
///
/// Bodies give way to a wave that is softer than the contact, K < k: from the length of the wave
/// with K = k on, what is next to each other does not know of each other's heights, and force goes
/// with area. K is what bending resists beyond the half-space, 1/K = 1/K_body - 2/(E q); k =
/// -(dF/dD)/A at rest of a made surface as large as that wave is long, with stiff bodies. A larger
/// one has a smaller k, but K falls with the fourth power of the length: found by going from short
/// lengths to longer ones.

#include "mems_stiction/device/device_force.hpp"

namespace mems_stiction {

/// The length [m]; infinite where one contact is stiff over its whole side.
/// - @p model with bodies that have a thickness
double mosaicLength(const DeviceSurfaces& surfaces, const DeviceArea& area, const Options& model,
                    const DeviceForceOptions& options);

/// The model with thick bodies, whose plate stays level.
Options stiffModel(const Options& model);

/// The force of a device from that of one place of its mosaic.
void takePlaces(const DeviceArea& area, double length, DeviceForce& force);

}  // namespace mems_stiction
