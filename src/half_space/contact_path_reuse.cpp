#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "half_space/contact_path.hpp"

// Reuses of the unloading branch along a loading branch that is the same branch of states.

namespace mems_stiction {
namespace {

/// States at one height whose forces differ by less than this, of the force, and their energies by
/// less than that, of the force times z0, are the same: states of the loading branch are as near as
/// their residuals are small.
constexpr double kSameForce = 5e-3;
constexpr double kSameEnergy = 1e-4;
/// The same energy of a state and of the curve between two others.
constexpr double kSameEnergyBetween = 1e-3;
/// States of the loading branch that a reuse from rest must pass, and states that are solved at
/// most to know the largest force.
constexpr int kFewestReused = 2;
constexpr int kMostOnSummit = 5;
/// The nearest state of the loading branch tells the stiffness if it is no farther than so many
/// first steps.
constexpr double kLongestFirstStep = 1.5;

bool isWeaker(const ForcePoint& one, const ForcePoint& other) { return one.force < other.force; }
bool isStronger(const ForcePoint& one, const ForcePoint& other) { return one.force > other.force; }

/// The curve at the share x of the step between two states.
ForcePoint between(const ForcePoint& from, const ForcePoint& to, double x) {
  const StepParabola parabola(from, to);
  const double move = to.height - from.height;
  ForcePoint point = from;
  point.height += x * move;
  point.force = parabola.at(x);
  point.energy += parabola.workTo(x) * move;
  return point;
}

/// Into a loading branch the order of its heights, in the place of what it has there.
void insert(const ForcePoint& point, std::vector<ForcePoint>& way) {
  const auto isBelow = [](const ForcePoint& one, const ForcePoint& other) {
    return one.height < other.height;
  };
  const auto place = std::lower_bound(way.begin(), way.end(), point, isBelow);
  if (place != way.end() && place->height == point.height) {
    *place = point;
  } else {
    way.insert(place, point);
  }
}

}  // namespace

bool ContactPath::isWayBack() const {
  return settings_.samples_curve && is_on_approach_ && minimiser_.flowed().empty() &&
         approach_.is_one_branch;
}

std::vector<ForcePoint> ContactPath::wayBack(const ForceCurve& curve) const {
  std::vector<ForcePoint> way;
  if (!isWayBack()) return way;
  const double smallest = kSmallestStep * settings_.step * minimiser_.law().range();
  for (auto point = approach_.points.rbegin(); point != approach_.points.rend(); ++point) {
    if (point->is_solved && point->height >= present_.height + smallest) way.push_back(*point);
  }
  const bool is_rest = curve.points.size() == 1;
  if (is_rest && !way.empty() && way.front().height > present_.height + kLongestFirstStep * step_)
    way.clear();
  return way;
}

void ContactPath::recordWay(const std::vector<ForcePoint>& way, double end, ForceCurve& curve) {
  for (const ForcePoint& point : way) {
    if (point.height > end) return;
    const bool is_rest = curve.points.size() == 1;
    record(point, false, curve);
    if (is_rest) noteStiffness();
  }
}

std::optional<ForcePoint> ContactPath::solveAt(const ForcePoint& target, double same_energy) {
  ForcePoint solved;
  ContactState state;
  const double force = forceScale();
  const double largest = std::max(strongest_, target.force);  // not what presses the bodies at rest
  const Accuracy accuracy{kSummit.residual, kSummit.force * largest / force};
  if (attempt(target.height, accuracy, solved, state) == PathStatus::kDone &&
      std::abs(solved.force - target.force) <= kSameForce * force &&
      std::abs(solved.energy - target.energy) <= same_energy * force * minimiser_.law().range()) {
    if (settings_.on_state) settings_.on_state(solved);
    return solved;
  }
  minimiser_.takeBack();
  return std::nullopt;
}

bool ContactPath::reuse(const ForcePoint& target) {
  is_on_approach_ = solveAt(target, kSameEnergy).has_value();
  return is_on_approach_;
}

bool ContactPath::reuseFromRest(ForceCurve& curve) {
  return reuseToSummit(curve) || reuseTowardsSummit(curve);
}

std::optional<ForcePoint> ContactPath::nextOnSummit(const std::vector<ForcePoint>& way,
                                                    const std::optional<ForcePoint>& top) const {
  const auto highest = std::max_element(way.begin(), way.end(), isWeaker);
  const auto first = highest == way.begin() ? highest : highest - 1;
  const auto last = highest + 1 == way.end() ? highest : highest + 1;
  ForcePoint summit = *highest;
  for (auto from = first; from != last; ++from) {
    const ForcePoint point = between(*from, *(from + 1), StepParabola(*from, *(from + 1)).summit());
    if (point.force > summit.force) summit = point;
  }
  if (!top || summit.force > (1.0 + kSummit.force) * top->force) return summit;
  const double largest_error = kLargestErrorOut / kSummitErrorShare * settings_.step / kUsualStep;
  for (auto from = first; from != last; ++from) {
    if (StepParabola(*from, *(from + 1)).curvatureError() > largest_error * top->force)
      return between(*from, *(from + 1), 0.5);
  }
  return std::nullopt;
}

bool ContactPath::reuseToSummit(ForceCurve& curve) {
  std::vector<ForcePoint> way = wayBack(curve);
  const auto highest = std::max_element(way.begin(), way.end(), isWeaker);
  if (highest - way.begin() < kFewestReused) return false;
  const auto isHigh = [&](const ForcePoint& point) {
    return point.force > kSummitForce * highest->force;
  };
  const auto first = std::find_if(way.begin(), highest, isHigh);
  const auto end = std::find_if_not(highest, way.end(), isHigh);
  const bool is_only_summit = std::is_sorted(first, highest, isWeaker) &&
                              std::is_sorted(highest, end, isStronger) &&
                              std::none_of(end, way.end(), isHigh);
  if (!is_only_summit || end == way.end()) return false;
  const ForcePoint rest = present_;
  std::optional<ForcePoint> top;  // the highest state that was solved
  auto target = nextOnSummit(way, top);
  for (int states = 0; target && states < kMostOnSummit; ++states) {
    const auto solved = solveAt(*target, kSameEnergyBetween);
    if (!solved) break;
    insert(*solved, way);
    if (!top || solved->force > top->force) top = solved;
    present_ = *solved;
    changing_move_ = present_.height - rest.height;
    target = nextOnSummit(way, top);
  }
  if (!top) return false;
  is_over_summit_ = !target;
  const double reached = std::max(present_.height, top->height);
  present_ = rest;
  recordWay(way, reached, curve);
  changing_move_ = present_.height - rest.height;
  step_ = kSmallestStep * settings_.step * minimiser_.law().range();
  return true;
}

bool ContactPath::reuseTowardsSummit(ForceCurve& curve) {
  const std::vector<ForcePoint> way = wayBack(curve);
  const auto highest = std::max_element(way.begin(), way.end(), isWeaker);
  if (highest == way.end()) return false;
  // the first of several, as behind each the unloading branch may be another branch for a while
  auto summit = std::find_if(way.begin(), highest, [&](const ForcePoint& point) {
    return point.force > kSummitForce * highest->force;
  });
  while (summit != highest && summit->force < (summit + 1)->force) ++summit;
  if (summit - way.begin() < kFewestReused || !reuse(*(summit - 1))) return false;
  const double from = present_.height;
  recordWay(way, (summit - 1)->height, curve);
  changing_move_ = present_.height - from;
  step_ = summit->height - present_.height;
  // the loading branch has told how the curve bends there
  const double curvature_error =
      kSummitErrorShare * curvatureErrorOf(*summit) * kUsualStep / settings_.step;
  if (curvature_error > kWantedError) step_ *= std::sqrt(kWantedError / curvature_error);
  return true;
}

bool ContactPath::reuseBehindSummit(ForceCurve& curve) {
  if (!is_over_summit_) return false;
  const std::vector<ForcePoint> way = wayBack(curve);
  const auto isBehind = [&](const ForcePoint& point) {
    return point.force < kSummitForce * curve.largest_force;
  };
  const auto behind = std::find_if(way.begin(), way.end(), isBehind);
  if (behind == way.end() || isStronger(way.front(), present_)) return false;
  const bool is_last_summit =
      std::is_sorted(way.begin(), behind, isStronger) && std::all_of(behind, way.end(), isBehind);
  if (!is_last_summit || !reuse(*behind)) return false;
  recordWay(way, way.back().height, curve);
  return true;
}

}  // namespace mems_stiction
