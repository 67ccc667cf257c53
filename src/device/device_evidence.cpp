#include "device/device_evidence.hpp"

#include "verdict/part_verdict.hpp"

namespace mems_stiction {

bool wantsDeviceForce(const DeviceOptions& device, const DeviceForceOptions& options) {
  return options.enabled && device.contact_area > 0.0 && (device.hasSpring() || device.hasBeam());
}

DeviceEvidence deviceEvidence(const DeviceForce& force) {
  DeviceEvidence evidence;
  evidence.pull_off_force = force.pull_off_force;
  evidence.apparent_work_of_adhesion = force.apparent_work_of_adhesion;
  evidence.force_factors = force.force_factors;
  evidence.work_factors = force.work_factors;
  if (force.is_cut_from_scans) evidence.contacts = force.contacts_of_scans;
  if (force.realisations.size() > 1) {
    const double freedom = static_cast<double>(force.realisations.size()) - 1.0;
    evidence.surface_reach = studentQuantile(freedom) * force.force_deviation;
  }
  evidence.linear_pull_off_force = force.linear_pull_off_force;
  evidence.warnings = force.warnings;
  evidence.missing_scan = force.missing_scan;
  return evidence;
}

}  // namespace mems_stiction
