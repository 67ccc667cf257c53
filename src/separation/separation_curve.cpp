#include "separation/separation_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// A search for the maximum that has not ended then takes the strongest state.
constexpr int kMostSearches = 8;
/// JKR's displacement at the pull-off over mu z0, 0.77 [-].
const double kHysteresisPerTabor = std::cbrt(9.0 * kPi / 8.0 * (9.0 * kPi / 8.0)) / 3.0;

/// 95 % of what the curve says without a doubt lie this near to the half-space, of it [-].
constexpr double kError = kNormal95 * chosen::kSureError.pull_off;

/// b of summits with this Tabor parameter, (S8a) [m].
double hysteresisOf(double tabor_parameter, double range) {
  if (!(tabor_parameter > chosen::kStiffTabor)) return 0.0;  // nor if it is not known
  return range * kHysteresisPerTabor * (tabor_parameter - chosen::kStiffTabor);
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

/// The strongest state, and the vertex of the parabola through it and the states beside it, if it
/// lies between them.
void takeVertex(const std::vector<SeparationState>& states, SeparationCurve& curve) {
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
/// not bend, of adhesion and field alone: water reaches no further. Bending takes a quarter at most
/// of the (4/3) Gamma (z0/(z0 - D))^2 that flat surfaces have left there.
int stepsApart(const FrameSums& frame) {
  const double left = 0.5 * std::log(1.0 / (3.0 * chosen::kAccuracy));
  const double reached = std::log(1.0 + frame.water().gapLimit() / frame.law().range());
  return static_cast<int>(std::ceil(std::max(left, reached) / std::log(1.0 + chosen::kStep)));
}

/// Approach some steps before first touch [m]. |D| + z0 grows by the same share each time.
double approachBefore(int steps, double range) {
  return range * (1.0 - std::pow(1.0 + chosen::kStep, steps));
}

/// Where many cells come in reach nearly at once, as those of a flat film beside a few summits: at
/// their smallest gap [m]; infinite where none do.
double filmBetween(const FrameSums& frame, double from, double to) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double window = 0.25 * frame.law().range();
  const double before = frame.cellsBelow(from);
  const double count = frame.cellsBelow(to) - before;
  if (!(count > before)) return kNone;
  // what contains more than half of them contains the middle one
  double low = from;
  double high = to;
  while (high - low > 0.25 * window) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) break;
    (frame.cellsBelow(middle) - before < 0.5 * count ? low : high) = middle;
  }
  const double first = std::max(low - window, from);
  const double within = frame.cellsBelow(high + window) - frame.cellsBelow(first);
  return within > chosen::kAtOnce * count ? first : kNone;
}

/// The approach of the next state, whose D + z0 is larger by a share; nearer where many cells come
/// in reach at once, since their attraction rises and falls within z0.
/// - @p first_touch of the surfaces [m]
/// - @p hysteresis by which the attraction may be that of nearer surfaces [m]
double approachAfter(const FrameSums& frame, double approach, double first_touch,
                     double hysteresis) {
  const double range = frame.law().range();
  const double step = chosen::kStep * (range + approach - first_touch);
  const double fine = chosen::kFineStep * range;
  if (!(step > 2.0 * fine)) return approach + step;
  const double reach = chosen::kReach * range + hysteresis;
  const double film = filmBetween(frame, approach, approach + step + reach);
  return approach + std::clamp(film - reach - approach, fine, step);
}

/// The next approach of the loading branch, which ends at the contact limit.
double loadingAfter(FrameSums& frame, double approach) {
  const double next = approachAfter(frame, approach, 0.0, 0.0);
  return next < frame.approachBeforeLimit() ? next : std::min(next, frame.limitApproach());
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
  stateAt(frame, above.approach, curve.branch);
  frame.mark();
  SeparationState found = below;
  curve.beyond_rest = below;
  const double narrow = chosen::kAccuracy * (below.approach - above.approach);
  for (int search = 0; below.approach - above.approach > narrow; ++search) {
    const double middle = 0.5 * (above.approach + below.approach);
    if (!(above.approach < middle && middle < below.approach)) break;  // no number lies between
    // every third time the middle: where one side is a wall, the line hardly moves the other
    const double place = search % 3 == 2 ? middle : crossing(above, below, load);
    found = stateAt(frame, place, curve.branch);
    const double excess = found.force() + load;
    if (std::abs(excess) <= chosen::kAccuracy * std::max(found.carried, load)) break;
    (excess >= 0.0 ? above : below) = found;
  }
  states.push_back(found);
}

}  // namespace

// (S11), but for the loads
SeparationState stateAt(FrameSums& frame, double approach, const Branch& branch,
                        double expected_end) {
  PlaceSums sums = frame.reach(approach, branch.largest_hysteresis, expected_end);
  SeparationState state;
  state.approach = approach;
  state.tabor_parameter = sums.taborParameter();
  // what has not been nearer than at rest holds nothing
  const double hysteresis =
      std::min(hysteresisOf(state.tabor_parameter, frame.law().range()), branch.largest_hysteresis);
  state.hysteresis = std::clamp(branch.rest - approach, 0.0, hysteresis);
  frame.add(approach, state.hysteresis, sums);
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

namespace {

/// The largest force. A parabola whose vertex rises far above the strongest state passes over a
/// bend of the curve: the state at its vertex takes part, until none does.
void takeMaximum(FrameSums& frame, SeparationCurve& curve) {
  std::vector<SeparationState>& states = curve.states;
  for (int search = 0;; ++search) {
    takeVertex(states, curve);
    const double most = (1.0 + chosen::kVertexRise) * states[curve.strongest].partingForce();
    if (!(curve.pull_off_force > most)) return;
    if (search == kMostSearches) break;
    const auto place = std::find_if(
        states.begin(), states.end(),
        [&](const SeparationState& state) { return state.approach >= curve.pull_off_approach; });
    if (place->approach == curve.pull_off_approach) break;
    states.insert(place, stateAt(frame, curve.pull_off_approach, curve.branch));
  }
  curve.pull_off_force = states[curve.strongest].partingForce();
  curve.pull_off_approach = states[curve.strongest].approach;
}

/// What a curve says once all of its states are there.
void takeFigures(FrameSums& frame, const EnergiesApart& apart, SeparationCurve& curve) {
  spreadEdges(curve.states);
  takeMaximum(frame, curve);
  takeWork(frame, apart, curve);
}

}  // namespace

std::vector<SeparationState>::const_iterator SeparationCurve::firstPushing() const {
  return std::find_if(states.begin(), states.end(),
                      [](const auto& state) { return state.givenForce() < 0.0; });
}

void followCurve(FrameSums& frame, const ContactSettings& settings, SeparationCurve& curve) {
  const double range = frame.law().range();
  const double load = settings.load.mechanical_load;
  curve.branch = {};
  curve.states.clear();
  for (int steps = stepsApart(frame); steps > 0; --steps) {
    curve.states.push_back(stateAt(frame, approachBefore(steps, range), curve.branch));
  }
  const EnergiesApart apart = energiesApart(frame, curve);
  curve.status = Status::kNoEquilibrium;
  double approach = 0.0;
  for (int step = 0; step < settings.approach.max_steps; ++step) {
    const double expected_rest = expectedRest(curve.states, load);
    // the force falls ever more steeply: rest may come a step before
    const double next = loadingAfter(frame, approach);
    if (expected_rest > 0.0 && expected_rest < next) frame.mark();
    curve.states.push_back(stateAt(frame, approach, curve.branch, expected_rest));
    const SeparationState& state = curve.states.back();
    if (state.force() + load < 0.0) {
      curve.status = Status::kEquilibrium;
      break;
    }
    if (state.contact_count >= frame.contactLimit()) {
      curve.status = Status::kBonded;
      break;
    }
    approach = next;
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
  const int steps_apart = stepsApart(frame);
  for (int step = static_cast<int>(loading.states.size()) - steps_apart;
       step < settings.approach.max_steps; ++step) {
    const double approach = loadingAfter(frame, before);
    if (!(approach > before)) break;
    const SeparationState state = stateAt(frame, approach, loading.branch);
    is_past = is_past || excess(state) > 0.0;
    if (is_past) largest = std::max(largest, state.partingForce());
    if (isPushedBack(state)) break;
    before = approach;
  }
  return largest;
}

bool isDrawnPastARest(const SeparationCurve& loading, double load, double force) {
  double before = 0.0;
  return std::any_of(loading.states.begin(), loading.states.end(),
                     [&](const SeparationState& state) {
                       before = std::max(before, state.partingForce());
                       return state.force() + load < chosen::kHardlyPast * state.carried &&
                              force > chosen::kDoubtedFactor * before;
                     });
}

bool hangsOnWhatIsCarried(const SeparationCurve& curve) {
  return std::any_of(curve.states.begin(), curve.firstPushing(), [&](const SeparationState& state) {
    return state.partingForce() + kError * state.carried > (1.0 + kError) * curve.pull_off_force;
  });
}

Branch unloadingOf(const SeparationCurve& loading, double range) {
  double softest = 0.0;
  for (const SeparationState& state : loading.states)
    softest = std::max(softest, state.tabor_parameter);
  return {loading.rest().approach, hysteresisOf(softest, range)};
}

void followUnloading(FrameSums& frame, double first_touch, const Branch& branch,
                     SeparationCurve& curve) {
  const double range = frame.law().range();
  curve.branch = branch;
  curve.states.clear();
  for (int steps = stepsApart(frame); steps > 0; --steps) {
    const double approach = first_touch + approachBefore(steps, range);
    curve.states.push_back(stateAt(frame, std::min(approach, branch.rest), branch));
    if (approach >= branch.rest) break;
  }
  double approach = first_touch;
  while (curve.states.back().approach < branch.rest) {
    curve.states.push_back(stateAt(frame, std::min(approach, branch.rest), branch));
    approach = approachAfter(frame, approach, first_touch, branch.largest_hysteresis);
  }
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
                  frame.hamakerExponentOfForce(strongest.approach, strongest.hysteresis));
  if (curve.pull_off_force > 0.0) {  // a0 goes with E z0^2/Gamma, E H/Gamma^2
    const double by_edges = strongest.edge_slope * attraction / curve.pull_off_force;
    pull_off.adhesion -= 2.0 * by_edges;
    pull_off.modulus += by_edges;
    pull_off.hamaker += by_edges;
  }
  return {pull_off, exponentsOf(curve.work, work, frame.hamakerExponentOfEnergy(last->approach))};
}

}  // namespace mems_stiction
