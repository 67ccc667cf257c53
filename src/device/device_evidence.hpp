#pragma once

/// @file
/// A device's force as evidence for its verdict, and when a verdict asks for it.

#include <vector>

#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/device/device_force_options.hpp"
#include "mems_stiction/verdict/device_options.hpp"
#include "mems_stiction/verdict/evidence.hpp"

namespace mems_stiction {

/// Whether the verdict on this device rests on its own force: it states a contact area and what is
/// to open it, and device_force/enabled.
bool wantsDeviceForce(const DeviceOptions& device, const DeviceForceOptions& options);

/// The distributions of force and work over their medians, ascending, and the 95 % intervals, which
/// are their quantiles.
void takeFactors(std::vector<double> of_force, std::vector<double> of_work, DeviceForce& force);

/// The figures of the force that a verdict needs.
DeviceEvidence deviceEvidence(const DeviceForce& force);

}  // namespace mems_stiction
