#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "half_space/contact_path.hpp"

// The unloading branch from rest; contact_path_reuse.cpp has its reuses of states along the loading
// branch, contact_path.cpp the steps of both ways.

namespace mems_stiction {
namespace {

/// The first step from rest where the stiffness is all that is asked for, of the usual one.
constexpr double kStiffnessStep = 0.125;
/// Change of the force that tells the stiffness, of the largest force: forces of states are out by
/// up to a thousandth of it. With less than that, stiffnesses of pressed soft bodies are wrong by
/// up to a factor of 1.7, or negative.
constexpr double kTellingChange = 0.03;

}  // namespace

PathStatus ContactPath::change(const TractionLaw& law) {
  minimiser_.setLaw(law);
  is_on_approach_ = false;
  last_move_ = changing_move_ = 0.0;
  ForcePoint relaxed;
  ContactState state;
  const PathStatus status = attempt(present_.height, kExact, relaxed, state);
  if (status != PathStatus::kDone) return status;
  changed_energy_ += relaxed.energy - present_.energy;
  present_ = relaxed;
  present_.energy -= minimiser_.acceptFlow(present_.height);
  strongest_ = std::max(0.0, present_.force);
  return PathStatus::kDone;
}

PathStatus ContactPath::retractFrom(Place&& place, ForceCurve& curve) {
  minimiser_.goTo(std::move(place.contact));
  minimiser_.setLaw(place.law);
  present_ = place.present;
  strongest_ = place.strongest;
  is_on_approach_ = place.is_on_approach;
  last_move_ = changing_move_ = 0.0;
  return retract(curve);
}

PathStatus ContactPath::goOut(ForceCurve& curve) {
  const double left = approach_.points.front().height - present_.height;
  return advance(1.0, left > 0.0 ? left : kLargestStep * step_,
                 -std::numeric_limits<double>::infinity(), curve);
}

PathStatus ContactPath::leaveRest() { return leaveRest(retraction_); }

PathStatus ContactPath::leaveRest(ForceCurve& curve) {
  curve.add(present_);
  const double share = settings_.samples_curve ? 1.0 : kStiffnessStep;
  step_ = std::min(share * settings_.step * minimiser_.law().range(), kLeastClosing * gapLeft());
  last_move_ = 0.0;  // the other way
  is_before_jump_ = false;
  is_over_summit_ = false;
  is_stiffness_known_ = measureStiffness();
  if (minimiser_.isCancelled()) return PathStatus::kCancelled;
  if (is_stiffness_known_ && !settings_.samples_curve) return PathStatus::kDone;
  if (reuseFromRest(curve)) return PathStatus::kDone;
  const PathStatus status = goOut(curve);
  if (status != PathStatus::kDone) return status;
  noteStiffness();
  reuseFromRest(curve);
  return status;
}

bool ContactPath::measureStiffness() {
  const auto& points = approach_.points;
  const auto isBefore = [&](const ForcePoint& point) {
    return point.is_solved && point.height > present_.height + step_;
  };
  const auto before = std::find_if(points.rbegin(), points.rend(), isBefore);
  if (before == points.rend() || states_ >= settings_.max_states) return false;
  const double estimate =
      std::abs(before->force - present_.force) / (before->height - present_.height);
  if (!(estimate > 0.0) || estimate * step_ >= kTellingChange * forceScale()) return false;
  const double way = kTellingChange * forceScale() / estimate;
  ForcePoint next;
  ContactState state;
  const bool is_solved = attempt(present_.height + way, kExact, next, state) == PathStatus::kDone;
  const bool is_smooth = is_solved && isSmoothTo(next);
  minimiser_.takeBack();
  if (!is_smooth) return false;
  // forces of pressed bodies are powers of the way
  stiffness_ = isHeavy(present_) && isHeavy(next)
                   ? present_.force * std::log(next.force / present_.force) / way
                   : (next.force - present_.force) / way;
  return true;
}

void ContactPath::noteStiffness() {
  if (last_move_ != 0.0 && !is_stiffness_known_) stiffness_ = last_parabola_.slope() / last_move_;
}

PathStatus ContactPath::retract(ForceCurve& curve) {
  const double end = approach_.points.front().height;
  PathStatus status = leaveRest(curve);
  while (status == PathStatus::kDone && (present_.height < end || present_.contact_area > 0.0)) {
    if (reuseBehindSummit(curve)) break;
    status = goOut(curve);
    is_over_summit_ = last_parabola_.end < last_parabola_.begin;
  }
  curve.missed_force = std::max(0.0, curve.missed_force - curve.largest_force);
  return status;
}

}  // namespace mems_stiction
