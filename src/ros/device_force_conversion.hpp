#pragma once

/// @file
/// From a device's force and its verdict to the message; field by field, no figure is computed
/// here.

#include <string>

#include <std_msgs/Header.h>

#include "mems_stiction/DeviceAdhesion.h"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// Without a verdict and without a status of its own: FOUND.
DeviceAdhesion deviceMessage(const DeviceForce& force, const LoadOptions& load,
                             const std_msgs::Header& header);

/// With the spring's force.
void fillVerdict(const Verdict& verdict, DeviceAdhesion& message);

/// REFUSED, with every figure NaN and no verdict.
/// - @p reason becomes the message, on one line
DeviceAdhesion refusedDevice(const std::string& reason, const LoadOptions& load,
                             const std_msgs::Header& header);

}  // namespace mems_stiction
