#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "half_space/contact_path.hpp"

// The way out from rest; contact_path.cpp has the steps of both ways.

namespace mems_stiction {
namespace {

/// States at one height whose forces differ by less than this, of the force, and their energies by less than that, of the
/// force times z0, are the same: states of the way in are as near as their residuals are small.
constexpr double kSameForce = 5e-3;
constexpr double kSameEnergy = 1e-4;
/// States of the way in that a leap from rest must pass.
constexpr int kFewestLeapt = 2;
/// The nearest of them tells the stiffness if it is no farther than so many first steps.
constexpr double kLongestFirstStep = 1.5;
/// The first step from rest where the stiffness is all that is asked for, of the usual one.
constexpr double kStiffnessStep = 0.125;

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

bool ContactPath::isWayBack() const {
  return settings_.samples_curve && is_on_approach_ && minimiser_.flowed().empty() && approach_.is_one_branch;
}

std::vector<ForcePoint> ContactPath::wayBack() const {
  std::vector<ForcePoint> way;
  if (!isWayBack()) return way;
  const double smallest = kSmallestStep * settings_.step * minimiser_.law().range();
  for (auto point = approach_.points.rbegin(); point != approach_.points.rend(); ++point) {
    if (point->is_solved && point->height >= present_.height + smallest) way.push_back(*point);
  }
  return way;
}

bool ContactPath::leap(const ForcePoint& target) {
  ForcePoint leapt;
  ContactState state;
  const double force = forceScale();
  const double largest = std::max(strongest_, target.force);  // not what presses the bodies at rest
  const Accuracy accuracy{kSummit.residual, kSummit.force * largest / force};
  if (attempt(target.height, accuracy, leapt, state) == PathStatus::kDone &&
      std::abs(leapt.force - target.force) <= kSameForce * force &&
      std::abs(leapt.energy - target.energy) <= kSameEnergy * force * minimiser_.law().range()) {
    if (settings_.on_state) settings_.on_state(leapt);
    return true;
  }
  minimiser_.takeBack();
  is_on_approach_ = false;
  return false;
}

void ContactPath::leapTowardsSummit(ForceCurve& curve) {
  const std::vector<ForcePoint> way = wayBack();
  const auto isWeaker = [](const ForcePoint& one, const ForcePoint& other) { return one.force < other.force; };
  const auto highest = std::max_element(way.begin(), way.end(), isWeaker);
  if (highest == way.end()) return;
  // the first of several, as behind each the way out may be another branch for a while
  auto summit = std::find_if(way.begin(), highest,
                             [&](const ForcePoint& point) { return point.force > kSummitForce * highest->force; });
  while (summit != highest && summit->force < (summit + 1)->force) ++summit;
  if (summit - way.begin() < kFewestLeapt) return;
  const bool is_rest = curve.points.size() == 1;  // whose stiffness the first step is to tell
  if ((is_rest && way.front().height > present_.height + kLongestFirstStep * step_) || !leap(*(summit - 1))) return;
  const double from = present_.height;
  for (auto point = way.begin(); point != summit; ++point) {
    record(*point, false, curve);
    if (is_rest && point == way.begin()) noteStiffness();
  }
  changing_move_ = present_.height - from;
  step_ = summit->height - present_.height;
  // the way in has told how the curve bends there
  const double sag = kSummitSagShare * sagOf(*summit) * kUsualStep / settings_.step;
  if (sag > kWantedSag) step_ *= std::sqrt(kWantedSag / sag);
}

bool ContactPath::leapBehindSummit(ForceCurve& curve) {
  if (last_parabola_.end >= last_parabola_.begin) return false;
  const std::vector<ForcePoint> way = wayBack();
  const auto isBehind = [&](const ForcePoint& point) { return point.force < kSummitForce * curve.largest_force; };
  const auto isStronger = [](const ForcePoint& one, const ForcePoint& other) { return one.force > other.force; };
  const auto behind = std::find_if(way.begin(), way.end(), isBehind);
  if (behind == way.end() || isStronger(way.front(), present_)) return false;
  const bool is_last_summit =
      std::is_sorted(way.begin(), behind, isStronger) && std::all_of(behind, way.end(), isBehind);
  if (!is_last_summit || !leap(*behind)) return false;
  for (const ForcePoint& point : way) record(point, false, curve);
  return true;
}

PathStatus ContactPath::goOut(ForceCurve& curve) {
  const double left = approach_.points.front().height - present_.height;
  return advance(1.0, left > 0.0 ? left : kLargestStep * step_, -std::numeric_limits<double>::infinity(), curve);
}

PathStatus ContactPath::leaveRest() { return leaveRest(retraction_); }

PathStatus ContactPath::leaveRest(ForceCurve& curve) {
  curve.add(present_);
  const double share = settings_.samples_curve ? 1.0 : kStiffnessStep;
  step_ = std::min(share * settings_.step * minimiser_.law().range(), kLeastClosing * gapLeft());
  last_move_ = 0.0;  // the other way
  is_before_jump_ = false;
  leapTowardsSummit(curve);
  if (curve.points.size() > 1) return PathStatus::kDone;
  const PathStatus status = goOut(curve);
  if (status != PathStatus::kDone) return status;
  noteStiffness();
  leapTowardsSummit(curve);
  return status;
}

void ContactPath::noteStiffness() {
  if (last_move_ != 0.0) stiffness_ = last_parabola_.slope() / last_move_;
}

PathStatus ContactPath::retract(ForceCurve& curve) {
  const double end = approach_.points.front().height;
  PathStatus status = leaveRest(curve);
  while (status == PathStatus::kDone && (present_.height < end || present_.contact_area > 0.0)) {
    if (leapBehindSummit(curve)) break;
    status = goOut(curve);
  }
  curve.missed_force = std::max(0.0, curve.missed_force - curve.largest_force);
  return status;
}

}  // namespace mems_stiction
