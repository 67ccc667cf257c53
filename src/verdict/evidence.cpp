#include "mems_stiction/verdict/evidence.hpp"

#include <cmath>

namespace mems_stiction {
namespace {

/// Of pixels, at two per cohesive length or more.
constexpr double kLatticeError = 0.02;

}  // namespace

SolvedHalfSpace unsolvedHalfSpace(const std::string& reason) {
  SolvedHalfSpace solution;
  solution.message = reason;
  return solution;
}

std::string whyNotJudging(const SolvedHalfSpace& solution) {
  if (solution.status != HalfSpaceStatus::kSolved) return solution.message;
  if (solution.path == HalfSpacePath::kRest) return kRestAlone;
  if (solution.may_tilt) return kMayTilt;
  if (!solution.is_resolved) return kPixelsTooLarge;
  if (!solution.is_step_converged)
    return "its steps are too large for the pull-off force: lower half_space/step";
  return "";
}

Prediction withHalfSpace(const Prediction& prediction, const SolvedHalfSpace& solution) {
  Prediction judged = prediction;
  judged.status = Status::kEquilibrium;
  judged.pull_off_force = judged.pull_off_force_jkr = judged.pull_off_force_transition =
      solution.pull_off_force;
  judged.apparent_work_of_adhesion = solution.work_of_adhesion;
  judged.model.respond = nullptr;  // the work is not that of its contacts
  return judged;
}

bool isScale(double factor) { return std::isfinite(factor) && factor > 0.0; }

DeviceEvidence scaled(DeviceEvidence device, double force_factor, double work_factor) {
  if (isScale(force_factor)) {
    device.pull_off_force *= force_factor;
    device.linear_pull_off_force *= force_factor;
  }
  if (isScale(work_factor)) device.apparent_work_of_adhesion *= work_factor;
  return device;
}

DeviceEvidence DeviceScale::under(const Prediction& contact) const {
  return scaled(device, contact.pull_off_force / frame_pull_off_force,
                contact.apparent_work_of_adhesion / frame_work);
}

double halfSpaceError(const SolvedHalfSpace& solution) {
  return std::hypot(kLatticeError, solution.pull_off_uncertainty / solution.pull_off_force);
}

}  // namespace mems_stiction
