#include "separation/separation_curve.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// JKR's displacement at the pull-off over mu z0, 0.77 [-].
const double kHoldPerTabor = std::cbrt(9.0 * kPi / 8.0 * (9.0 * kPi / 8.0)) / 3.0;

/// 95 % of what the curve says without a doubt lie this near to the half-space, of it [-].
constexpr double kError = kNormal95 * chosen::kSureError.pull_off;

/// b of summits with this Tabor parameter, (S8a) [m].
double holdOf(double tabor_parameter, double range) {
  if (!(tabor_parameter > chosen::kStiffTabor)) return 0.0;  // nor if it is not known
  return range * kHoldPerTabor * (tabor_parameter - chosen::kStiffTabor);
}

/// B, (S7) [-].
double bendingFactor(const PlaceSums& sums) {
  if (!(sums.weight > 0.0)) return 1.0;
  const double loss = chosen::kLossInCompany * sums.loss +
                      (1.0 - chosen::kLossInCompany) * sums.loss_alone / sums.weight;
  return 1.0 - loss / sums.weight;
}

/// Gives states that are too far apart for any patch the edges of the first one that is not.
void spreadEdges(std::vector<SeparationState>& states) {
  for (std::size_t i = states.size() - 1; i-- > 0;) {
    if (states[i].is_in_reach) continue;
    states[i].edge_share = states[i + 1].edge_share;
    states[i].edge_slope = states[i + 1].edge_slope;
    states[i].width = states[i + 1].width;
  }
}

/// The vertex of the parabola through three points of the curve, if it lies between them; else the
/// middle one.
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
  const double rise =
      (states[best].partingForce() - before.partingForce()) / (middle - before.approach);
  const double fall =
      (after.partingForce() - states[best].partingForce()) / (after.approach - middle);
  const double bend = (fall - rise) / (after.approach - before.approach);
  if (!(bend < 0.0)) return;
  const double slope = rise + bend * (middle - before.approach);
  const double move =
      std::clamp(-0.5 * slope / bend, before.approach - middle, after.approach - middle);
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

/// What adhesion gives at most: summits that stay in contact while they are drawn out do not give
/// more [J].
double mostAdhesion(const FrameSums& frame) { return frame.law().workOfAdhesion() * frame.area(); }

/// What both give before the first state [J].
struct EnergiesApart {
  double adhesion;
  double lasting_field;
};

EnergiesApart energiesApart(FrameSums& frame, const SeparationCurve& curve) {
  const double approach = curve.states.front().approach;
  return {frame.energy(approach), frame.lastingFieldEnergy(approach)};
}

/// Integrals along the states; the part before the first one by its energies.
void takeWork(const FrameSums& frame, const EnergiesApart& apart, SeparationCurve& curve) {
  curve.elastic_energy = 0.0;
  curve.work_apart = apart.adhesion;
  curve.lasting_field_apart = apart.lasting_field;
  curve.work = apart.adhesion + apart.lasting_field;
  double adhesion = apart.adhesion;
  for (std::size_t i = 1; i < curve.states.size(); ++i) {
    const SeparationState& from = curve.states[i - 1];
    const SeparationState& to = curve.states[i];
    const double length = to.approach - from.approach;
    curve.elastic_energy += 0.5 * (from.carried + to.carried) * length;
    curve.work += positivePart(from.givenForce(), to.givenForce(), length);
    adhesion += 0.5 * (from.adhesion + to.adhesion) * length;
  }
  curve.work -= std::max(0.0, adhesion - mostAdhesion(frame));
}

/// What a curve says once all of its states are there.
void takeFigures(const FrameSums& frame, const EnergiesApart& apart, SeparationCurve& curve) {
  spreadEdges(curve.states);
  takeMaximum(curve.states, curve);
  takeWork(frame, apart, curve);
}

/// The parts of a force or a work.
struct Parts {
  double adhesion = 0.0;
  double carried = 0.0;
  double lasting_field = 0.0;
};

/// Of a figure with its parts: attraction, what of it goes with ln(Hamaker constant), load of the
/// patches, and field, which goes with the square of the contact potential. The law's range goes
/// with sqrt(H/Gamma), so that at a given H Gamma moves the attraction by the rest.
Exponents exponentsOf(double figure, const Parts& parts, double hamaker_exponent) {
  if (!(figure > 0.0)) return {};
  const double by_hamaker = parts.adhesion * hamaker_exponent;
  return {(parts.adhesion - by_hamaker) / figure, -parts.carried / figure, by_hamaker / figure,
          2.0 * parts.lasting_field / figure};
}

/// Steps before first touch. What is left of the work where they begin is that of bodies which do
/// not bend: bending takes a quarter at most of the (4/3) Gamma (z0/(z0 - D))^2 that flat surfaces
/// have left there.
int stepsApart() {
  static const int steps = static_cast<int>(
      std::ceil(std::log(1.0 / (3.0 * chosen::kAccuracy)) / (2.0 * std::log(1.0 + chosen::kStep))));
  return steps;
}

/// Approach after some steps from first touch, below 0 before it. |D| + z0 grows by the same share
/// each time.
double approachAfter(int steps, double range) {
  if (steps < 0) return range * (1.0 - std::pow(1.0 + chosen::kStep, -steps));
  return range * (std::pow(1.0 + chosen::kStep, steps) - 1.0);
}

/// The approach of a step of the loading branch, which ends at the contact limit.
double loadingAfter(FrameSums& frame, int step) {
  const double approach = approachAfter(step, frame.law().range());
  return approach < frame.approachBeforeLimit() ? approach
                                                : std::min(approach, frame.limitApproach());
}

/// Where the force of the last two states comes down to -load if it goes on as it does: it falls
/// ever more steeply. 0 while it does not fall.
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
void settle(FrameSums& frame, double load, SeparationCurve& curve) {
  std::vector<SeparationState>& states = curve.states;
  SeparationState below = states.back();
  states.pop_back();
  SeparationState above = states.back();
  stateAt(frame, above.approach, curve.way);
  frame.mark();
  SeparationState found = below;
  curve.beyond_rest = below;
  const double narrow = chosen::kAccuracy * (below.approach - above.approach);
  for (int search = 0; below.approach - above.approach > narrow; ++search) {
    const double middle = 0.5 * (above.approach + below.approach);
    if (!(above.approach < middle && middle < below.approach)) break;  // no number lies between
    // every third time the middle: where one side is a wall, the line hardly moves the other
    const double place = search % 3 == 2 ? middle : crossing(above, below, load);
    found = stateAt(frame, place, curve.way);
    const double excess = found.force() + load;
    if (std::abs(excess) <= chosen::kAccuracy * std::max(found.carried, load)) break;
    (excess >= 0.0 ? above : below) = found;
  }
  states.push_back(found);
}

}  // namespace

// (S11), but for the loads
SeparationState stateAt(FrameSums& frame, double approach, const Way& way, double expected_end) {
  PlaceSums sums = frame.reach(approach, way.longest_hold, expected_end);
  SeparationState state;
  state.approach = approach;
  state.tabor_parameter = sums.taborParameter();
  // what has not been nearer than at rest holds nothing
  const double hold =
      std::min(holdOf(state.tabor_parameter, frame.law().range()), way.longest_hold);
  state.hold = std::clamp(way.rest - approach, 0.0, hold);
  frame.add(approach, state.hold, sums);
  state.contact_count = sums.contact_count;
  state.carried = sums.carried;
  state.electrostatic = sums.electrostatic;
  state.lasting_field = frame.load().lastingFieldShare() * sums.electrostatic;
  state.capillary = sums.capillary;
  state.is_in_reach = sums.weight > 0.0;
  if (state.is_in_reach) {
    state.width = sums.width / sums.weight;
    state.edge_share = 1.0 - sums.edge_loss / sums.weight;
    state.edge_slope = sums.edge_slope / (sums.weight * state.edge_share);
  }
  state.adhesion = bendingFactor(sums) * std::max(sums.adhesion - sums.opened, 0.0);
  return state;
}

std::vector<SeparationState>::const_iterator SeparationCurve::firstPushing() const {
  return std::find_if(states.begin(), states.end(),
                      [](const auto& state) { return state.givenForce() < 0.0; });
}

void followCurve(FrameSums& frame, const ContactSettings& settings, SeparationCurve& curve) {
  const double range = frame.law().range();
  const double load = settings.load.mechanical_load;
  curve.way = {};
  curve.states.clear();
  for (int step = -stepsApart(); step < 0; ++step) {
    curve.states.push_back(stateAt(frame, approachAfter(step, range), curve.way));
  }
  const EnergiesApart apart = energiesApart(frame, curve);
  curve.status = Status::kNoEquilibrium;
  for (int step = 0; step < settings.approach.max_steps; ++step) {
    const double approach = loadingAfter(frame, step);
    const double expected_rest = expectedRest(curve.states, load);
    // the force falls ever more steeply: rest may come a step before
    if (expected_rest > 0.0 && expected_rest < loadingAfter(frame, step + 1)) frame.mark();
    curve.states.push_back(stateAt(frame, approach, curve.way, expected_rest));
    const SeparationState& state = curve.states.back();
    if (state.force() + load < 0.0) {
      curve.status = Status::kEquilibrium;
      break;
    }
    if (state.contact_count >= frame.contactLimit()) {
      curve.status = Status::kBonded;
      break;
    }
  }
  if (curve.status == Status::kEquilibrium) settle(frame, load, curve);
  takeFigures(frame, apart, curve);
}

SeparationState restIfElastic(const GapField& field, const ContactSettings& settings) {
  FrameSums frame;
  frame.start(field, settings, nullptr, false);
  SeparationCurve elastic;
  followCurve(frame, settings, elastic);
  return elastic.rest();
}

double forceFromNextRest(FrameSums& frame, const ContactSettings& settings,
                         const SeparationCurve& loading) {
  const auto excess = [&](const SeparationState& state) {
    return state.force() + settings.load.mechanical_load;
  };
  const auto isPushedBack = [&](const SeparationState& state) {
    return -excess(state) > kError * state.carried;
  };
  if (loading.status != Status::kEquilibrium || isPushedBack(loading.beyond_rest)) return 0.0;
  double largest = 0.0;
  bool is_past = false;  // what keeps the surfaces from coming nearer
  double before = loading.beyond_rest.approach;
  for (int step = static_cast<int>(loading.states.size()) - stepsApart();
       step < settings.approach.max_steps; ++step) {
    const double approach = loadingAfter(frame, step);
    if (!(approach > before)) break;
    const SeparationState state = stateAt(frame, approach, loading.way);
    is_past = is_past || excess(state) > 0.0;
    if (is_past) largest = std::max(largest, state.partingForce());
    if (isPushedBack(state)) break;
    before = approach;
  }
  return largest;
}

bool isDrawnPastARest(const SeparationCurve& loading, double load) {
  double before = 0.0;
  return std::any_of(loading.states.begin(), loading.states.end(),
                     [&](const SeparationState& state) {
                       before = std::max(before, state.partingForce());
                       return state.capillary > 0.0 &&
                              state.force() + load < chosen::kHardlyPast * state.carried &&
                              loading.pull_off_force > chosen::kDoubtedFactor * before;
                     });
}

bool hangsOnWhatIsCarried(const SeparationCurve& curve) {
  return std::any_of(curve.states.begin(), curve.firstPushing(), [&](const SeparationState& state) {
    return state.partingForce() + kError * state.carried > (1.0 + kError) * curve.pull_off_force;
  });
}

Way unloadingOf(const SeparationCurve& loading, double range) {
  double softest = 0.0;
  for (const SeparationState& state : loading.states)
    softest = std::max(softest, state.tabor_parameter);
  return {loading.rest().approach, holdOf(softest, range)};
}

void followUnloading(FrameSums& frame, double first_touch, const Way& way, SeparationCurve& curve) {
  const double range = frame.law().range();
  curve.way = way;
  curve.states.clear();
  int step = -stepsApart();
  do {
    const double approach = first_touch + approachAfter(step++, range);
    curve.states.push_back(stateAt(frame, std::min(approach, way.rest), way));
  } while (curve.states.back().approach < way.rest);
  const EnergiesApart apart = energiesApart(frame, curve);
  takeFigures(frame, apart, curve);
}

CurveExponents exponentsOf(FrameSums& frame, const SeparationCurve& curve) {
  // force and work are stationary in the displacements where they are taken: their parts there tell
  // how they change
  const SeparationState& strongest = curve.states[curve.strongest];
  Parts work;
  work.adhesion = curve.work_apart;
  work.lasting_field = curve.lasting_field_apart;
  const SeparationState* last = &curve.states.front();
  for (std::size_t i = 1; i < curve.states.size(); ++i) {
    const SeparationState& from = curve.states[i - 1];
    const SeparationState& to = curve.states[i];
    if (!(from.givenForce() + to.givenForce() > 0.0))
      continue;  // a step that pushes more than it pulls
    const double length = to.approach - from.approach;
    work.adhesion += 0.5 * (from.adhesion + to.adhesion) * length;
    work.carried += 0.5 * (from.carried + to.carried) * length;
    work.lasting_field += 0.5 * (from.lasting_field + to.lasting_field) * length;
    last = &to;
  }
  work.adhesion = std::min(work.adhesion, mostAdhesion(frame));
  const double attraction = strongest.edge_share * strongest.adhesion;
  Exponents pull_off =
      exponentsOf(curve.pull_off_force, {attraction, strongest.carried, strongest.lasting_field},
                  frame.hamakerExponentOfForce(strongest.approach, strongest.hold));
  if (curve.pull_off_force > 0.0) {  // a0 goes with E z0^2/Gamma, E H/Gamma^2
    const double by_edges = strongest.edge_slope * attraction / curve.pull_off_force;
    pull_off.adhesion -= 2.0 * by_edges;
    pull_off.modulus += by_edges;
    pull_off.hamaker += by_edges;
  }
  return {pull_off, exponentsOf(curve.work, work, frame.hamakerExponentOfEnergy(last->approach))};
}

}  // namespace mems_stiction
