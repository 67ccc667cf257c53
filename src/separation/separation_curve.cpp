#include "mems_stiction/separation/separation_curve.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mems_stiction {
namespace {

/// Approaches before first touch, of z0, where the curve begins; from the last one on it has steps of kStep z0.
constexpr double kApart[] = {-12.0, -8.0, -6.0, -4.5, -3.5, -2.8, -2.2, -1.8, -1.5, -1.2, -1.0};
constexpr double kStep = 0.1;
/// Steps grow with the approach, so that few of them go deep.
constexpr double kStepPerApproach = 0.05;
/// Surfaces that carry this many times what can pull them together push each other apart from there on, though patches
/// that gain a rim may carry a little less for a while: so many steps are left to rest.
constexpr double kPushing = 2.0;
constexpr int kPushingSteps = 8;
/// Most places that are tried for it, and what the forces there may lack of what is carried.
constexpr int kRestSearches = 24;
constexpr double kRestAccuracy = 1e-3;

/// The vertex of the parabola through three points of the curve, if it lies between them; else the middle one.
void takeMaximum(const std::vector<SeparationState>& states, SeparationCurve& curve) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (states[i].partingForce() > states[best].partingForce()) best = i;
  }
  curve.pull_off_force = std::max(0.0, states[best].partingForce());
  curve.pull_off_approach = states[best].approach;
  curve.strongest = best;
  if (best == 0 || best + 1 == states.size() || !(curve.pull_off_force > 0.0)) return;
  const SeparationState& before = states[best - 1];
  const SeparationState& after = states[best + 1];
  const double middle = states[best].approach;
  const double rise = (states[best].partingForce() - before.partingForce()) / (middle - before.approach);
  const double fall = (after.partingForce() - states[best].partingForce()) / (after.approach - middle);
  const double bend = (fall - rise) / (after.approach - before.approach);
  if (!(bend < 0.0)) return;
  const double slope = rise + bend * (middle - before.approach);
  const double move = std::clamp(-0.5 * slope / bend, before.approach - middle, after.approach - middle);
  curve.pull_off_approach = middle + move;
  curve.pull_off_force = states[best].partingForce() + move * (slope + bend * move);
}

/// Integral over a step of a line from `from` to `to`, of its part above 0.
double positivePart(double from, double to, double length) {
  if (from >= 0.0 && to >= 0.0) return 0.5 * (from + to) * length;
  if (from <= 0.0 && to <= 0.0) return 0.0;
  const double positive = std::max(from, to);
  return 0.5 * positive * length * positive / std::abs(from - to);
}

/// Integrals along the states; the part before the first one by its energies.
void takeWork(double work_apart, SeparationCurve& curve) {
  curve.elastic_energy = 0.0;
  curve.work = curve.work_apart = work_apart;
  for (std::size_t i = 1; i < curve.states.size(); ++i) {
    const SeparationState& from = curve.states[i - 1];
    const SeparationState& to = curve.states[i];
    const double length = to.approach - from.approach;
    curve.elastic_energy += 0.5 * (from.carried + to.carried) * length;
    curve.work += positivePart(from.partingForce(), to.partingForce(), length);
  }
}

/// Of a figure with its parts: attraction, what of it goes with ln(Hamaker constant), and load of the patches. The law's
/// range goes with sqrt(H/Gamma), so that at a given H Gamma moves the attraction by the rest.
Exponents exponentsOf(double figure, double adhesion, double hamaker_exponent, double carried) {
  if (!(figure > 0.0)) return {};
  const double by_hamaker = adhesion * hamaker_exponent;
  return {(adhesion - by_hamaker) / figure, -carried / figure, by_hamaker / figure};
}

double nextApproach(double approach, double range) {
  return approach + std::max(kStep * range, kStepPerApproach * approach);
}

/// Where the force of the last two states comes down to -load if it goes on as it does: it falls ever more steeply. 0 while it
/// does not fall.
double expectedRest(const std::vector<SeparationState>& states, double load) {
  const SeparationState& last = states.back();
  const SeparationState& before = states[states.size() - 2];
  const double fall = before.force() - last.force();
  if (!(fall > 0.0)) return 0.0;
  return last.approach + (last.force() + load) / fall * (last.approach - before.approach);
}

/// Where F + F_m falls to 0 between two states, by the forces' line.
double crossing(const SeparationState& above, const SeparationState& below, double load) {
  const double excess = above.force() + load;
  const double lack = -(below.force() + load);
  const double share = excess + lack > 0.0 ? excess / (excess + lack) : 1.0;
  return above.approach + share * (below.approach - above.approach);
}

/// Puts the state of rest at the end: the crossing between the last two states.
void settle(SeparationTrace& trace, double load, SeparationCurve& curve) {
  std::vector<SeparationState>& states = curve.states;
  SeparationState below = states.back();
  states.pop_back();
  SeparationState above = states.back();
  trace.restart();
  trace.at(above.approach);
  trace.keep();
  for (int search = 0; search < kRestSearches; ++search) {
    if (search > 0) trace.backToKept();
    // every third time the middle: where one side is a wall, the line hardly moves the other
    const double place = search % 3 == 2 ? 0.5 * (above.approach + below.approach) : crossing(above, below, load);
    const SeparationState found = trace.at(place);
    const double excess = found.force() + load;
    const bool is_rest = std::abs(excess) <= kRestAccuracy * std::max(found.carried, load);
    (excess >= 0.0 ? above : below) = found;
    if (is_rest || search + 1 == kRestSearches) {
      states.push_back(found);
      break;
    }
  }
}

/// Largest rise after a fall, going from a state on [N].
template <typename Iterator>
double riseAfterFall(Iterator state, Iterator end) {
  double lowest = state->partingForce();
  double rise = 0.0;
  for (; state != end; ++state) {
    lowest = std::min(lowest, state->partingForce());
    rise = std::max(rise, state->partingForce() - lowest);
  }
  return rise;
}

}  // namespace

std::vector<SeparationState>::const_iterator SeparationCurve::firstPushing() const {
  return std::find_if(states.begin(), states.end(), [](const auto& state) { return state.partingForce() < 0.0; });
}

double joiningRise(const SeparationCurve& curve) {
  const auto end = curve.firstPushing();
  const auto largest = std::max_element(curve.states.begin(), end, [](const auto& one, const auto& other) {
    return one.partingForce() < other.partingForce();
  });
  if (largest == end || !(largest->partingForce() > 0.0)) return 0.0;
  const double outwards = riseAfterFall(std::make_reverse_iterator(largest + 1), curve.states.rend());
  return std::max(riseAfterFall(largest, end), outwards) / largest->partingForce();
}

void followCurve(SeparationTrace& trace, const ContactSettings& settings, SeparationCurve& curve) {
  const double range = trace.law().range();
  const double load = settings.load.mechanical_load;
  curve.states.clear();
  for (const double apart : kApart) curve.states.push_back(trace.at(apart * range));
  const double work_apart = trace.energyAt(curve.states.front());
  curve.status = Status::kNoEquilibrium;
  int steps = 0;
  while (steps++ < settings.approach.max_steps) {
    double approach = nextApproach(curve.states.back().approach, range);
    if (approach >= trace.approachBeforeLimit()) approach = std::min(approach, trace.limitApproach());
    curve.states.push_back(trace.at(approach, expectedRest(curve.states, load)));
    const SeparationState& state = curve.states.back();
    if (state.force() + load < 0.0) {
      curve.status = Status::kEquilibrium;
      break;
    }
    if (state.contact_count >= trace.contactLimit()) {
      curve.status = state.force() + load < 0.0 ? Status::kEquilibrium : Status::kBonded;
      break;
    }
  }
  if (curve.status == Status::kEquilibrium) settle(trace, load, curve);
  takeMaximum(curve.states, curve);
  takeWork(work_apart, curve);
}

void followCurveUpTo(SeparationTrace& trace, double first_touch, double rest, SeparationCurve& curve) {
  const double range = trace.law().range();
  curve.states.clear();
  for (const double apart : kApart) {
    const double approach = first_touch + apart * range;
    if (approach < rest) curve.states.push_back(trace.at(approach));
  }
  if (curve.states.empty()) curve.states.push_back(trace.at(rest));
  const double work_apart = trace.energyAt(curve.states.front());
  double pushing_step = 0.0;
  while (curve.states.back().approach < rest) {
    const SeparationState& last = curve.states.back();
    if (pushing_step == 0.0 && last.carried > kPushing * trace.strongestPull()) {
      pushing_step = (rest - last.approach) / kPushingSteps;
    }
    const double step_end = first_touch + nextApproach(last.approach - first_touch, range);
    curve.states.push_back(trace.at(std::min(std::max(step_end, last.approach + pushing_step), rest)));
  }
  takeMaximum(curve.states, curve);
  takeWork(work_apart, curve);
}

CurveExponents exponentsOf(SeparationTrace& trace, const SeparationCurve& curve) {
  // force and work are stationary in the displacements where they are taken: their parts there tell how they change
  const SeparationState& strongest = curve.states[curve.strongest];
  double adhesion = curve.work_apart;
  double carried = 0.0;
  const SeparationState* last = &curve.states.front();
  for (std::size_t i = 1; i < curve.states.size(); ++i) {
    const SeparationState& from = curve.states[i - 1];
    const SeparationState& to = curve.states[i];
    if (!(from.partingForce() + to.partingForce() > 0.0)) continue;  // a step that pushes more than it pulls
    const double length = to.approach - from.approach;
    adhesion += 0.5 * (from.adhesion + to.adhesion) * length;
    carried += 0.5 * (from.carried + to.carried) * length;
    last = &to;
  }
  return {
      exponentsOf(curve.pull_off_force, strongest.adhesion, trace.hamakerExponentOfForce(strongest), strongest.carried),
      exponentsOf(curve.work, adhesion, trace.hamakerExponentOfEnergy(*last), carried)};
}

}  // namespace mems_stiction
