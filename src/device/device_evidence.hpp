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

/// Force and work with their intervals times the factors, as of scaled() in evidence.hpp.
DeviceForce scaled(DeviceForce force, double force_factor, double work_factor);

/// The force as a verdict by the half-space has it: the device's figures move as those of the
/// frame do, and the half-space has answered what the curve doubts.
/// - @p frame the prediction of the scan that was solved
/// - @p evidence with device and half_space, which judge
DeviceForce judgedByHalfSpace(DeviceForce force, const Prediction& frame, const Options& options,
                              const UncertaintyOptions& uncertainty, const Evidence& evidence);

/// The figures of the force that a verdict needs.
DeviceEvidence deviceEvidence(const DeviceForce& force);

}  // namespace mems_stiction
