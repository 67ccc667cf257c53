#include "device/device_evidence.hpp"

#include <utility>

#include "verdict/margin_uncertainty.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {

void DeviceForceOptions::describe(OptionVisitor& visitor) {
  visitor.flag("device_force/enabled", enabled,
               "whether a device that states its contact area is judged by the force of such an "
               "area; the node finds it "
               "beside its predictions");
  visitor.integer("device_force/realisations", realisations, Range::within(3, 1000),
                  "surfaces of the device's size that are made and brought to contact");
  visitor.number(
      "device_force/pitch", pitch, "m", Range::nonNegative(),
      "distance of neighbouring pixels of the made surfaces; 0 = that of the finest scan");
  visitor.number("device_force/max_cells", max_cells, "", Range::within(1e4, 1e11),
                 "pixels of one made surface; the force of a larger area is continued from those");
  visitor.flag("device_force/own_long_waves", own_long_waves,
               "whether a scan as wide as the device gives its own long waves, so that the force "
               "is that of its place; "
               "no = of any place of "
               "such a surface");
  visitor.integer("device_force/seed", seed, Range::nonNegative(),
                  "the same seed gives the same surfaces");
}

bool wantsDeviceForce(const DeviceOptions& device, const DeviceForceOptions& options) {
  return options.enabled && device.contact_area > 0.0 && (device.hasSpring() || device.hasBeam());
}

void takeFactors(std::vector<double> of_force, std::vector<double> of_work, DeviceForce& force) {
  force.force_factors = std::move(of_force);
  force.work_factors = std::move(of_work);
  force.pull_off_force_lower = force.pull_off_force * quantile(force.force_factors, kLowerShare);
  force.pull_off_force_upper = force.pull_off_force * quantile(force.force_factors, kUpperShare);
  force.apparent_work_of_adhesion_lower =
      force.apparent_work_of_adhesion * quantile(force.work_factors, kLowerShare);
  force.apparent_work_of_adhesion_upper =
      force.apparent_work_of_adhesion * quantile(force.work_factors, kUpperShare);
}

DeviceForce scaled(DeviceForce force, double force_factor, double work_factor) {
  if (isScale(force_factor)) {
    for (double* const value : {&force.pull_off_force, &force.pull_off_force_lower,
                                &force.pull_off_force_upper, &force.linear_pull_off_force}) {
      *value *= force_factor;
    }
    for (Realisation& made : force.realisations) made.pull_off_force *= force_factor;
  }
  if (isScale(work_factor)) {
    for (double* const value :
         {&force.apparent_work_of_adhesion, &force.apparent_work_of_adhesion_lower,
          &force.apparent_work_of_adhesion_upper}) {
      *value *= work_factor;
    }
  }
  return force;
}

DeviceForce judgedByHalfSpace(DeviceForce force, const Prediction& frame, const Options& options,
                              const UncertaintyOptions& uncertainty, const Evidence& evidence) {
  const SolvedHalfSpace& solution = *evidence.half_space;
  force = scaled(std::move(force), solution.pull_off_force / frame.pull_off_force,
                 solution.work_of_adhesion / frame.apparent_work_of_adhesion);
  AdhesionSpread spread = adhesionSpread(frame, options, uncertainty, evidence);
  takeFactors(std::move(spread.pull_off), std::move(spread.apparent_work), force);
  return force;
}

DeviceEvidence deviceEvidence(const DeviceForce& force) {
  DeviceEvidence evidence;
  evidence.pull_off_force = force.pull_off_force;
  evidence.apparent_work_of_adhesion = force.apparent_work_of_adhesion;
  evidence.force_factors = force.force_factors;
  evidence.work_factors = force.work_factors;
  evidence.force_factors_without_doubt = force.force_factors_without_doubt;
  evidence.work_factors_without_doubt = force.work_factors_without_doubt;
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
