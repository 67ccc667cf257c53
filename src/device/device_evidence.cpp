#include "device/device_evidence.hpp"

#include <algorithm>

namespace mems_stiction {

bool wantsDeviceForce(const DeviceOptions& device, const DeviceForceOptions& options) {
  return options.enabled && device.contact_area > 0.0 && (device.hasSpring() || device.hasBeam());
}

DeviceEvidence deviceEvidence(const DeviceForce& force) {
  DeviceEvidence evidence;
  evidence.pull_off_force = force.pull_off_force;
  evidence.force_deviation = force.force_deviation;
  evidence.apparent_work_of_adhesion = force.apparent_work_of_adhesion;
  evidence.work_deviation = force.work_deviation;
  evidence.freedom = std::max(1.0, static_cast<double>(force.realisations.size()) - 1.0);
  evidence.linear_pull_off_force = force.linear_pull_off_force;
  evidence.warnings = force.warnings;
  return evidence;
}

}  // namespace mems_stiction
