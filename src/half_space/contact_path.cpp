#include "half_space/contact_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace mems_stiction {
namespace {

/// Smallest steps, of the usual one, beside kSmallestStep: on the loading branch, which may be the
/// unloading branch, and behind its first jump; and where the largest force of the retraction may
/// depend on it.
constexpr double kSmallestStepIn = 0.25;
constexpr double kSmallestStepBehindJump = 1.0;
constexpr double kFinestStep = 0.03125;
/// Smallest step where the branch rises beyond the largest force, of the usual one: from a stiff
/// rest the force may rise by a tenth over the finest one, and end by a jump.
constexpr double kSummitStep = 0.001;
/// Distance of the curve's points, those between solved states included, of the usual step.
constexpr double kPointDistance = 0.25;
/// Share of the largest force that steps over a jump may miss before they become finer.
constexpr double kNegligibleMiss = 0.005;
/// The curvature error, as kWantedError, that is taken back on the loading branch. A parabola with
/// a curvature error errs by a quarter of it where the curve is smooth. A jump that passes for a
/// smooth step adds up to its curvature error to the work that is lost, and frames have chains of
/// them.
constexpr double kLargestError = 0.03;
/// A change of slope from one step to the next, over the step and of the force, counts as a
/// curvature error of this share: a step over a jump may by chance have the mean of its ends, but
/// not the slope with which it began. The second where the branch was on its way to the largest
/// force of all, the third where it is near.
constexpr double kKinkShare = 0.2;
constexpr double kRisingKinkShare = 0.5;
constexpr double kSummitKinkShare = 1.5;
/// The smallest step that misses more than this goes over a jump; on the unloading branch, whose
/// work counts, what is taken back at all.
constexpr double kJumpError = 0.06;
/// Without attraction no jump can be missed, and the force need not be followed below this share of
/// the load: what states are out by there would ask for ever smaller steps.
constexpr double kToldShare = 0.1;
/// Bodies are pressed heavily where they carry more than this many times the largest attraction so
/// far, as a jump of as much attraction would be less than kJumpError there, and where their
/// contacts bear more on average than the law attracts.
constexpr double kHeavyLoad = 1.0 / kJumpError;
/// Curvature errors there, wanted and largest: that of a force which grows by the factor of 5.5.
constexpr double kWantedHeavyError = 0.3;
constexpr double kLargestHeavyError = 0.6;
/// By which factor the force is to grow over a step there, where it can be foreseen.
constexpr double kHeavyGrowth = 4.5;
/// A force that is farther than this factor is not aimed at: the step before leads to this share of
/// it.
constexpr double kAimedGrowth = 1.3;
constexpr double kShareBefore = 0.93;
/// The largest step there, of the usual one.
constexpr double kLargestHeavyStep = 128.0;
/// What a cell may move in one Newton step there, of z0: attraction hardly shapes the way, and the
/// line search bounds it.
constexpr double kLongestHeavyMove = 30.0;
/// Behind the summit, states with less than this share of the force lead to rest: the first step
/// out, whose slope is the stiffness, may end in one of them.
constexpr double kTowardsRest = 0.75;
/// Force beside that of rest from which on a state is exact, of the largest force: it may be rest.
constexpr double kMaybeRest = 0.01;
/// How often a force is aimed at, and how far from there at once, of the step that missed it.
constexpr int kMostAims = 5;
constexpr double kShortestAim = 0.05;
constexpr double kLongestAim = 2.0;
/// On the unloading branch, curvature errors with which heights of the loading branch are taken up
/// again.
constexpr double kPlannedError = 0.015;
/// Steps are compared with limits but for rounding.
constexpr double kStepTolerance = 1.001;
/// Steps grow and shrink by no more than this at once.
constexpr double kLargestChange = 2.0;
/// On the loading branch, where most states are, a step also changes by the ratio of the last two
/// curvature errors to this power, by no more than that.
constexpr double kTrendPower = 0.2;
constexpr double kLargestTrend = 1.4;
/// Newton steps of a state that does not follow smoothly: the next step is no longer.
constexpr int kManyNewtonSteps = 12;
/// Heights that differ by less, of the usual step, are the same but for rounding.
constexpr double kSameHeight = 1e-6;
/// The present change is continued over no more than this many times its length.
constexpr double kLongestContinuation = 4.0;
/// By how much the mean gap falls in one step at most, beside kLeastClosing: the pressure in full
/// contact grows sixfold.
constexpr double kMostClosing = 0.5;
/// Force that may be left at rest, of the force: the area of bonded surfaces grows steeply there.
constexpr double kRestForce = 3e-4;
/// A step beyond rest becomes as long as its parabola says, but no shorter than this share of it.
/// Where it leads over a jump the parabola may say the same again and again: after so many attempts
/// it is halved at least.
constexpr double kLeastOfStep = 0.05;
constexpr int kMostShortened = 2;
constexpr double kShareBeyondRest = 0.5;
/// A state beyond rest counts as rest when it is no farther from the last one than this, of the
/// usual step.
constexpr double kRestStep = 1e-5;
/// Height at which the approach begins, of z0, at least, and over that at which a flat of the
/// frame's size would jump.
constexpr double kStartHeight = 4.0;
constexpr double kStartMargin = 1.25;

}  // namespace

void ForceCurve::add(const ForcePoint& point) {
  if (points.empty() || point.force > largest_force) {
    largest_force = point.force;
    largest_height = point.height;
  }
  points.push_back(point);
}

ContactPath::ContactPath(ContactMinimiser& minimiser, const PathSettings& settings)
    : minimiser_(minimiser), settings_(settings), step_(settings.step * minimiser.law().range()) {}

double ContactPath::startHeight() const {
  const TractionLaw& law = minimiser_.law();
  const double z0 = law.range();
  // -t' = (8 Gamma/z0^2) (z0/g)^4 equals the stiffness of the longest wave
  const double softest =
      std::isfinite(minimiser_.smallestStiffness()) ? minimiser_.smallestStiffness() : 0.0;
  const double jump = softest > 0.0 ? std::pow(3.0 * law.stress() / (z0 * softest), 0.25) : 0.0;
  return z0 * std::max(kStartHeight, kStartMargin * jump) + (law.reach() - z0);
}

double ContactPath::largestLoad() const {
  if (approach_.points.empty()) return minimiser_.largestLoad();
  double load = 0.0;
  for (const ForcePoint& point : approach_.points) load = std::max(load, -point.force);
  return load;
}

bool ContactPath::isHeavy(const ForcePoint& point) const {
  // without attraction nothing jumps
  const double contact = strongest_ > 0.0 ? minimiser_.law().stress() * point.contact_area : 0.0;
  return point.force < -std::max(kHeavyLoad * strongest_, contact);
}

double ContactPath::forceScale() const { return std::max(std::abs(present_.force), strongest_); }

double ContactPath::leftAtRest(double load) const {
  return kRestForce * std::max(forceScale(), load);
}

double ContactPath::curvatureErrorOf(const ForcePoint& next) const {
  const StepParabola parabola(present_, next);
  // of the smaller one: a step from a large load to none must not miss the attraction
  const double scale = std::max({strongest_, next.force, least_force_,
                                 std::min(std::abs(present_.force), std::abs(next.force))});
  return scale > 0.0 ? parabola.curvatureError() / scale : 0.0;
}

bool ContactPath::isSmoothTo(const ForcePoint& next) const {
  return curvatureErrorOf(next) <= kJumpError;
}

double ContactPath::kinkOf(const ForcePoint& next) const {
  const double scale = std::max(strongest_, next.force);
  if (last_move_ == 0.0 || !(scale > 0.0)) return 0.0;
  const double begun = (last_parabola_.slope() + 2.0 * last_parabola_.bend()) / last_move_;
  const double move = next.height - present_.height;
  return std::abs(StepParabola(present_, next).slope() - begun * move) /
         std::max(scale, std::abs(next.force));
}

PathStatus ContactPath::attempt(double height, const Accuracy& accuracy, ForcePoint& next,
                                ContactState& state) {
  const double move = height - present_.height;
  const double share =
      changing_move_ != 0.0
          ? std::clamp(move / changing_move_, -kLongestContinuation, kLongestContinuation)
          : 0.0;
  minimiser_.moveOn(share);
  return settle(height, accuracy, next, state);
}

ContactPath::Accuracy ContactPath::summitAccuracy() const { return isWayBack() ? kSummit : kExact; }

ContactPath::Accuracy ContactPath::accuracyOf(bool is_in, double step,
                                              const ForceCurve& curve) const {
  if (!minimiser_.flowed().empty()) return kExact;
  if (is_in) {
    const bool is_falling = last_move_ != 0.0 && last_parabola_.end < last_parabola_.begin;
    const bool leads_to_rest = is_falling && present_.force < kTowardsRest * strongest_;
    return curve.is_one_branch && !is_before_jump_ && !leads_to_rest ? kPassingIn : kPassing;
  }
  // the first step out tells the stiffness
  if (!settings_.samples_curve || last_move_ == 0.0) return kExact;
  const bool is_far =
      std::max(present_.force, continued(step)) < kSummitForce * curve.largest_force;
  return is_far ? kPassingOut : summitAccuracy();
}

PathStatus ContactPath::settle(double height, const Accuracy& accuracy, ForcePoint& next,
                               ContactState& state) {
  ContactMinimiser::Search search;
  if (isHeavy(present_)) search.longest_move = kLongestHeavyMove;
  search.tolerance = accuracy.residual;
  search.residual_norm = accuracy.force * forceScale() / minimiser_.grid().frameArea();
  state = minimiser_.solve(height, search);
  ++states_;
  newton_steps_ += state.newton_steps;
  products_ += state.products;
  if (minimiser_.isCancelled()) return PathStatus::kCancelled;
  if (!state.is_converged) return PathStatus::kNotConverged;
  next = {height, state.force, state.energy, state.contact_area, state.mean_gap, true};
  // what a residual leaves is no attraction, against which contacts would have to be pressed
  // heavily
  if (!minimiser_.law().attracts()) next.force = std::min(next.force, 0.0);
  if (accuracy.residual == 1.0) largest_residual_ = std::max(largest_residual_, state.residual);
  return PathStatus::kDone;
}

double ContactPath::continued(double move) const {
  if (last_move_ == 0.0) return present_.force;
  // at its end; over small steps energies say little about it, but no monotonous parabola is
  // steeper there than this
  const double change = 2.0 * std::abs(last_parabola_.end - last_parabola_.begin);
  const double rise = std::min(last_parabola_.slope() + 2.0 * last_parabola_.bend(), change);
  const double bend = std::min(0.0, last_parabola_.bend());
  double further = std::max(0.0, move / last_move_);
  if (rise + 2.0 * bend * further < 0.0)
    further = std::max(0.0, -0.5 * rise / bend);  // where it is highest
  return present_.force + std::max(0.0, further * (rise + bend * further));
}

void ContactPath::record(const ForcePoint& next, bool is_jump, ForceCurve& curve) {
  const double move = next.height - present_.height;
  const StepParabola parabola(present_, next);
  const double attracting = parabola.attractingShare();
  if (is_jump) {
    ++curve.jumps;
    curve.work += 0.5 * (parabola.begin + parabola.end) * move;
    curve.attracting_work +=
        0.5 * (std::max(0.0, parabola.begin) + std::max(0.0, parabola.end)) * attracting * move;
    curve.missed_force = std::max(curve.missed_force, continued(move));
  } else {
    curve.work += parabola.mean * move;
    if (parabola.begin > 0.0) curve.attracting_work += parabola.workTo(attracting) * move;
    if (parabola.begin <= 0.0)
      curve.attracting_work += (parabola.mean - parabola.workTo(1.0 - attracting)) * move;
    const double usual = settings_.step * minimiser_.law().range();
    const int pieces = static_cast<int>(std::ceil(std::abs(move) / (kPointDistance * usual)));
    const bool is_heavy = isHeavy(present_) && isHeavy(next);
    const std::optional<PressedStep> pressed =
        is_heavy ? std::make_optional<PressedStep>(parabola) : std::nullopt;
    // energies that do not belong to the forces tell of several branches, not of a parabola
    const bool is_smooth = is_heavy || isSmoothTo(next);
    std::vector<double> shares;  // of the step, where points are
    for (int piece = 1; is_smooth && piece < pieces; ++piece)
      shares.push_back(static_cast<double>(piece) / pieces);
    const double summit = is_smooth && !is_heavy ? parabola.summit() : 0.0;
    if (summit > 0.0 && summit < 1.0)
      shares.insert(std::upper_bound(shares.begin(), shares.end(), summit), summit);
    for (const double x : shares) {
      ForcePoint between = present_;
      between.height += x * move;
      between.force = pressed ? pressed->at(x) : parabola.at(x);
      if (!minimiser_.law().attracts()) between.force = std::min(between.force, 0.0);
      between.energy += (pressed ? pressed->workTo(x) : parabola.workTo(x)) * move;
      const double grown = next.force - present_.force;
      const double share = is_heavy && grown != 0.0 ? (between.force - present_.force) / grown : x;
      between.contact_area += share * (next.contact_area - present_.contact_area);
      between.mean_gap += x * (next.mean_gap - present_.mean_gap);
      between.is_solved = false;
      curve.add(between);
    }
  }
  curve.add(next);
  present_ = next;
  last_move_ = changing_move_ = is_jump ? 0.0 : move;
  last_parabola_ = parabola;
  strongest_ = std::max(strongest_, next.force);
}

void ContactPath::accept(const ForcePoint& next, bool is_jump, ForceCurve& curve) {
  record(next, is_jump, curve);
  present_.energy -= minimiser_.acceptFlow(next.height);
  if (settings_.on_state) settings_.on_state(next);
}

double ContactPath::crossingOf(const StepParabola& parabola, double force, double from,
                               double to) const {
  if (isHeavy(present_) && PressedStep::fits(parabola) && force < 0.0) {
    return crossing(PressedStep(parabola), force, from, to);
  }
  return crossing(parabola, force, from, to);
}

bool ContactPath::mayExceed(double direction, double step, double force) const {
  return direction > 0.0 && continued(step) > (1.0 + kNegligibleMiss) * force;
}

double ContactPath::forceWithin(double force) const {
  if (!isHeavy(present_) || force > kAimedGrowth * present_.force) return force;
  return std::max(kShareBefore * force, kHeavyGrowth * present_.force);
}

double ContactPath::stepTo(double force) const {
  if (last_move_ == 0.0) return step_;
  const double farthest = 1.0 + step_ / std::abs(last_move_);
  return (crossingOf(last_parabola_, force, 1.0, farthest) - 1.0) * std::abs(last_move_);
}

double ContactPath::gapLeft() const {
  const double left = present_.mean_gap - minimiser_.law().narrowestGap();
  const bool is_free = minimiser_.grid().boundary == HalfSpaceBoundary::kFree;
  return !is_free && left > 0.0 ? left : std::numeric_limits<double>::infinity();
}

double ContactPath::closingStep(double force) const {
  const TractionLaw& law = minimiser_.law();
  const double left = gapLeft();
  if (!std::isfinite(left)) return left;
  // the law repels the more steeply the narrower a gap is: the mean pressure is at least that of
  // the mean gap
  const double to_force = present_.mean_gap - law.gapUnder(-force / minimiser_.validArea());
  return std::clamp(to_force, kLeastClosing * left, kMostClosing * left);
}

void ContactPath::planStep() {
  if (!isHeavy(present_)) return;
  const double smallest = kSmallestStep * settings_.step * minimiser_.law().range();
  for (auto point = approach_.points.rbegin();
       point != approach_.points.rend() && point->force < 0.0; ++point) {
    if (!point->is_solved || point->height < present_.height + smallest) continue;
    const double curvature_error = curvatureErrorOf(*point) * kUsualStep / settings_.step;
    if (curvature_error > (isHeavy(*point) ? kLargestHeavyError : kPlannedError)) break;
    step_ = point->height - present_.height;
  }
}

void ContactPath::takeBackForPart(const ForcePoint& missed) {
  minimiser_.takeBackForPart();
  changing_move_ = missed.height - present_.height;
}

void ContactPath::takeBackAndAim(const ForcePoint& missed, double force) {
  takeBackForPart(missed);
  const double share = crossingOf(StepParabola(present_, missed), force, 0.0, kLongestAim);
  step_ = std::abs(changing_move_) * std::max(share, kShortestAim);
}

double ContactPath::smallestStep(bool is_in) const {
  const double usual = settings_.step * minimiser_.law().range();
  return (is_in || !settings_.is_resolved ? kSmallestStepIn : kSmallestStep) * usual;
}

double ContactPath::leastStep(bool is_in, const ForceCurve& curve) const {
  const bool is_behind_jump = is_in && !curve.is_one_branch;
  return is_behind_jump ? kSmallestStepBehindJump * settings_.step * minimiser_.law().range()
                        : smallestStep(is_in);
}

ContactPath::Judgement ContactPath::judge(const ForcePoint& next, double direction, double step,
                                          const ForceCurve& curve) const {
  const double usual = settings_.step * minimiser_.law().range();
  const bool is_in = direction < 0.0;
  const bool is_unloading = !is_in && settings_.samples_curve;
  const double largest_error_out = settings_.is_resolved ? kLargestErrorOut : kLargestError;
  const double at_most = std::max({curve.largest_force, next.force, 0.0});
  const bool may_exceed = mayExceed(direction, step, at_most);
  const bool is_at_summit = is_unloading && present_.force > kSummitForce * at_most;
  const bool touches_summit = is_at_summit || (is_unloading && next.force > kSummitForce * at_most);
  const double kink_share = is_at_summit ? kSummitKinkShare
                            : may_exceed ? kRisingKinkShare
                                         : kKinkShare;
  const double curvature_share = is_at_summit ? kSummitErrorShare : 1.0;
  // finer usual steps are to miss less, too
  const double curvature_error =
      std::max(curvature_share * curvatureErrorOf(next), kink_share * kinkOf(next)) * kUsualStep /
      settings_.step;
  const bool is_heavy = isHeavy(present_) && isHeavy(next);
  const bool is_coarse = is_heavy || !settings_.samples_curve;
  const double wanted_error = is_coarse ? kWantedHeavyError : kWantedError;
  const double largest_error = is_coarse      ? kLargestHeavyError
                               : is_unloading ? largest_error_out
                                              : kLargestError;
  // a jump loses energy: the mean of both forces does more work than the energies tell
  const StepParabola parabola(present_, next);
  const bool loses = (0.5 * (parabola.begin + parabola.end) - parabola.mean) * direction > 0.0;
  const bool is_jump = loses && !is_heavy &&
                       curvatureErrorOf(next) > (is_unloading ? largest_error_out : kJumpError);
  // how steeply a branch rises that begins here is not known: its end may be the largest force of
  // all
  const bool may_miss = may_exceed || (!is_in && last_move_ == 0.0);
  // the force of pressed surfaces rises steeply, but a jump is none the less one in steps that are
  // finer
  const bool is_pressed = std::min(present_.force, next.force) < 0.0;
  const bool is_fine = may_miss || touches_summit || (is_pressed && !is_jump);
  const bool is_finest = may_exceed || (may_miss && is_jump);
  const double smallest = leastStep(is_in, curve);
  const double finest = is_finest ? kSummitStep * usual : is_fine ? kFinestStep * usual : smallest;
  return {curvature_error, wanted_error, largest_error, finest, is_jump, is_heavy};
}

double ContactPath::changeOfStep(const Judgement& judged, bool is_in, int newton_steps) const {
  const auto within = [](double change, double most) {
    return std::clamp(change, 1.0 / most, most);
  };
  double change = within(std::sqrt(judged.wanted_error / std::max(judged.curvature_error, 1e-12)),
                         kLargestChange);
  if (judged.is_heavy) return change;
  if (newton_steps > kManyNewtonSteps) change = std::min(change, 1.0);
  if (!is_in || last_error_ == 0.0) return change;
  // steps that grow worse are shortened before they are too long (Gustafsson, ACM TOMS 17 (1991)
  // 533)
  change *= within(std::pow(last_error_ / std::max(judged.curvature_error, 1e-12), kTrendPower),
                   kLargestTrend);
  return within(change, kLargestChange);
}

PathStatus ContactPath::advance(double direction, double farthest, double least_force,
                                ForceCurve& curve) {
  const double usual = settings_.step * minimiser_.law().range();
  const bool is_in = direction < 0.0;
  const bool is_unloading = !is_in && settings_.samples_curve;
  const double smallest = leastStep(is_in, curve);
  bool is_aimed = false;  // the step leads to least_force as far as is known
  int aims = 0;
  int shortened = 0;
  if (!is_in && curve.points.size() > 1) planStep();
  while (true) {
    if (states_ >= settings_.max_states) return PathStatus::kTooManyStates;
    const double next_force = forceWithin(least_force);
    const double wanted = is_aimed ? step_ : stepTo(next_force);
    is_aimed = is_aimed || (wanted < step_ && next_force == least_force);
    double step = std::min(std::max(wanted, kRestStep * usual), farthest);
    if (is_in) step = std::min(step, closingStep(least_force));
    const double to_jump = is_before_jump_ ? direction * (jump_height_ - present_.height) : 0.0;
    if (is_before_jump_) {
      const double nearest =
          mayExceed(direction, to_jump, curve.largest_force) ? finest_ : smallest;
      step = std::min(step, to_jump <= kStepTolerance * nearest ? to_jump : 0.5 * to_jump);
    }
    const double move = direction * step;
    ForcePoint next;
    ContactState state;
    // a way to somewhere else, or a force that is to be another one
    const bool is_passed = is_in && !settings_.samples_curve;
    const bool is_rough = isHeavy(present_) && (is_aimed || is_passed);
    const Accuracy accuracy = is_rough ? kRough : accuracyOf(is_in, step, curve);
    PathStatus status = attempt(present_.height + move, accuracy, next, state);
    if (is_rough && status == PathStatus::kDone && is_aimed && aims < kMostAims &&
        std::abs(next.force - least_force) > kRestForce * -least_force) {
      ++aims;
      takeBackAndAim(next, least_force);
      continue;
    }
    if (accuracy.residual > 1.0 && status == PathStatus::kDone) {
      const bool may_flow = is_rough ? minimiser_.hasFlow() : minimiser_.isNearFlow();
      const double near = std::max(leftAtRest(-least_force), kMaybeRest * forceScale());
      const double beyond = least_force - next.force;
      const bool is_rest = beyond > -near && (beyond < near || step <= kRestStep * usual);
      if ((is_rough && is_aimed) || is_rest || may_flow) {
        status = settle(present_.height + move, kExact, next, state);
      } else if (is_unloading && accuracy.force > kSummit.force &&
                 next.force > kSummitForce * curve.largest_force) {
        status = settle(present_.height + move, summitAccuracy(), next, state);
      }
    }
    if (status == PathStatus::kCancelled) return status;
    if (status == PathStatus::kNotConverged) {
      if (step <= kFinestStep * usual) return status;
      minimiser_.takeBack();
      step_ = step / kLargestChange;
      continue;
    }
    const Judgement judged = judge(next, direction, step, curve);
    if (judged.curvature_error > judged.largest_error && step > kStepTolerance * judged.finest) {
      minimiser_.takeBack();
      if (judged.is_jump) {
        is_before_jump_ = true;
        jump_height_ = present_.height + move;
        finest_ = judged.finest;
      }
      step_ = std::max(
          judged.finest,
          step * std::clamp(std::sqrt(judged.wanted_error / judged.curvature_error), 0.25, 0.5));
      is_aimed = false;
      continue;
    }
    if (next.force < least_force - leftAtRest(-least_force) && step > kRestStep * usual) {
      if (judged.is_heavy) {
        minimiser_.takeBack();
      } else {
        takeBackForPart(next);
      }
      const double most = ++shortened > kMostShortened ? kShareBeyondRest : 1.0 - kRestForce;
      step_ = step * std::clamp(crossing(StepParabola(present_, next), least_force, 0.0, 1.0),
                                kLeastOfStep, most);
      farthest = step;
      is_aimed = true;
      continue;
    }
    curve.is_one_branch =
        curve.is_one_branch && !judged.is_jump && judged.curvature_error <= judged.largest_error;
    accept(next, judged.is_jump, curve);
    is_before_jump_ =
        is_before_jump_ && direction * (jump_height_ - present_.height) > kSameHeight * usual;
    const double wanted_next = step * changeOfStep(judged, is_in, state.newton_steps);
    const double longest = (judged.is_heavy ? kLargestHeavyStep : kLargestStep) * usual;
    step_ = std::clamp(wanted_next, std::min(smallestStep(is_in), step), longest);
    last_error_ = judged.curvature_error;
    return PathStatus::kDone;
  }
}

PathStatus ContactPath::begin(double height) {
  while (true) {
    ForcePoint first;
    ContactState state;
    last_move_ = changing_move_ = 0.0;
    present_.height = height;
    const PathStatus status = attempt(height, kExact, first, state);
    if (status != PathStatus::kDone) return status;
    if (first.contact_area == 0.0) {
      present_ = first;
      strongest_ = std::max(0.0, first.force);
      approach_.add(first);
      if (settings_.on_state) settings_.on_state(first);
      return PathStatus::kDone;
    }
    minimiser_.takeBack();
    height *= kLargestChange;
    if (states_ >= settings_.max_states) return PathStatus::kTooManyStates;
  }
}

PathStatus ContactPath::approach(double load) {
  if (load > minimiser_.largestLoad()) return PathStatus::kLoadNotReached;
  least_force_ = minimiser_.law().attracts() ? 0.0 : kToldShare * load;
  PathStatus status = begin(startHeight());
  double lowest = -minimiser_.largestRelief() - kStartHeight * minimiser_.law().range();
  if (std::isfinite(minimiser_.smallestStiffness())) {
    lowest -= load / (minimiser_.grid().frameArea() * minimiser_.smallestStiffness());
  }
  while (status == PathStatus::kDone) {
    if (present_.height <= lowest) return PathStatus::kLoadNotReached;
    status = advance(-1.0, std::max(present_.height - lowest, step_), -load, approach_);
    if (present_.force + load <= leftAtRest(load)) break;
  }
  return status;
}

}  // namespace mems_stiction
