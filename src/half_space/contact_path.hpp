#pragma once

/// @file
/// Which states does a contact go through while the upper body comes down and is lifted again?
///
/// The height Z of the upper body is prescribed, so a state is left only where it is no longer a
/// minimum of the energy: the surfaces then jump into contact or apart, at constant Z. As dE/dZ = F
/// between jumps, each step says by itself how well it samples the curve: the mean force from the
/// energies against the mean of the forces at both ends. Steps that miss too much are taken back
/// and halved, so jumps are met in small steps, the finer the more they matter to the largest
/// force; where the curve is straight, steps grow. Between two states without a jump the force is
/// the parabola through both with the mean that the energies give.
///
/// Where bodies bear many times the largest attraction, and their contacts more than the law
/// attracts, a jump is no longer told from the bend of the curve, and the force may grow fivefold
/// from one state to the next: between them its logarithm is the parabola. The unloading branch
/// takes heights of the loading branch. A load is aimed at by states with a rough residual, until
/// one has its force.
///
/// A loading branch without a jump is one branch of minima, which the unloading branch follows
/// back: it then goes straight from rest to where the curve of the loading branch is highest,
/// solves the few states that the largest force takes, and goes straight to the state behind. All
/// of them must be what the loading branch had there, or the unloading branch goes on in steps.
/// What has flowed, and another law, make it another branch. States of the loading branch, but
/// rest, and of the unloading branch far from the largest force have rough residuals; near the
/// largest force where the unloading branch is the loading branch, too. Behind the first jump of
/// the loading branch only where it leads to counts: its jumps are met in steps of the usual size.
///
/// What a voltage adds to the traction goes at rest, at constant height, before the bodies are
/// drawn apart: the device opens when its loads have gone. A contact potential stays. From there to
/// no force the unloading branch takes the load that the voltage was, and then the mechanical one.

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "half_space/contact_minimiser.hpp"
#include "half_space/force_step.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"

namespace mems_stiction {

/// The curve in one direction.
struct ForceCurve {
  void add(const ForcePoint& point);

  std::vector<ForcePoint> points;
  double work = 0.0;             ///< integral of F dZ over the points, signed as Z went [J]
  double attracting_work = 0.0;  ///< the part of it over heights with attraction [J]
  double largest_force =
      0.0;  ///< of the points, which have the summits of the parabolas between states [N]
  double largest_height = 0.0;  ///< where [m]
  double missed_force = 0.0;    ///< what finer steps may find beyond largest_force [N]
  int jumps = 0;                ///< steps over which the force cannot be continuous
  bool is_one_branch =
      true;  ///< no step is a jump, or has missed so much that there may be a small one in it
};

enum class PathStatus { kDone, kCancelled, kNotConverged, kLoadNotReached, kTooManyStates };

/// How the path is followed.
struct PathSettings {
  double step = 0.4;  ///< usual change of Z, of z0
  /// false: only where it leads matters, not the curve
  bool samples_curve = true;
  /// false: jumps are of the lattice, from pixel to pixel, and need not be met in small steps
  bool is_resolved = true;
  int max_states = 2000;                            ///< solved in all
  std::function<void(const ForcePoint&)> on_state;  ///< after each; may be empty
};

/// Follows the states of a minimiser.
class ContactPath {
 public:
  /// Usual step for which curvature errors apply, of z0. Finer ones are to miss less, and their
  /// states must be as much more exact.
  static constexpr double kUsualStep = 0.4;

  ContactPath(ContactMinimiser& minimiser, const PathSettings& settings);

  /// From apart until the bodies press each other with `load` [N], >= 0, without further force.
  PathStatus approach(double load);
  /// Another law applies from now on: what is out of equilibrium then relaxes at the present
  /// height.
  PathStatus change(const TractionLaw& law);
  /// From there until they are apart.
  PathStatus retract() { return retract(retraction_); }

  /// The first step of that.
  PathStatus leaveRest();
  /// dF/dZ where they left rest; NaN where they jumped [N/m].
  double stiffness() const { return stiffness_; }

  /// A state to come back to.
  struct Place {
    ContactMinimiser::Place contact;
    TractionLaw law;
    ForcePoint present;
    double strongest;
    bool is_on_approach;  ///< under the law of the loading branch
  };
  Place place() const {
    return {minimiser_.place(), minimiser_.law(), present_, strongest_, is_on_approach_};
  }
  /// Once more until they are apart, from another state.
  PathStatus retractFrom(Place&& place, ForceCurve& curve);

  const ForceCurve& approachCurve() const { return approach_; }
  const ForceCurve& retractionCurve() const { return retraction_; }
  /// By which changes of the law have moved the energy, at constant height [J].
  double changedEnergy() const { return changed_energy_; }
  const ForcePoint& present() const { return present_; }
  /// The largest load of any state [N], or that of all cells flowing if that is smaller than what
  /// was asked for.
  double largestLoad() const;
  double largestResidual() const { return largest_residual_; }
  int stateCount() const { return states_; }
  int newtonSteps() const { return newton_steps_; }
  int products() const { return products_; }

 private:
  /// How near to equilibrium a state is to be.
  struct Accuracy {
    double residual;  ///< the largest one, of the tolerance
    double force;  ///< root of the mean square of the residual, of the largest force over the frame
  };
  static constexpr Accuracy kExact{1.0, std::numeric_limits<double>::infinity()};
  /// On the way to other states of heavily pressed bodies.
  static constexpr Accuracy kRough{300.0, std::numeric_limits<double>::infinity()};
  /// On the loading branch until something jumps or rest is near, and behind; on the unloading
  /// branch, far from the largest force; and near it, where the unloading branch is the loading
  /// branch. But for rest and what flows. Set, as the smallest steps and kSameForce and kSameEnergy
  /// are, on `studies/trust --half-space-steps` of seeds 32 and 34, the last one on 32 and 35, the
  /// first one on 60 frames of each page of kinds and on seeds 38 and 39. Exact states take a
  /// seventh more time on the loading branch and a tenth on the unloading branch of frames that
  /// jump, and are no nearer to finer steps; kPassing all the loading branch takes a tenth more on
  /// frames that do not jump; 1000 in place of 300, or 300 behind jumps, puts 1 % of the areas and
  /// forces out, and near rest stiffnesses by up to 13 %; 100 on retraction 1 to 2 % of the works,
  /// and states like kSummit over the small steps that meet a jump 8 % of the forces.
  static constexpr Accuracy kPassingIn{300.0, 0.05};
  static constexpr Accuracy kPassing{100.0, 0.01};
  static constexpr Accuracy kPassingOut{30.0, 0.01};
  static constexpr Accuracy kSummit{100.0, 1e-3};
  /// Smallest step of the unloading branch, whose jumps tell force and work, and largest step, of
  /// the usual one.
  static constexpr double kSmallestStep = 0.125;
  static constexpr double kLargestStep = 8.0;
  /// Near the largest force is more than this share of it.
  static constexpr double kSummitForce = 0.9;
  /// How far the mean force of a step may lie from the mean of its ends, of the force: wanted; and
  /// so many times it counts near the largest force.
  static constexpr double kWantedError = 0.01;
  static constexpr double kSummitErrorShare = 2.0;
  /// The curvature error that is taken back on the unloading branch.
  static constexpr double kLargestErrorOut = 0.015;
  /// By how much the mean gap of a periodic frame may fall in any step, of its distance to the
  /// narrowest gap.
  static constexpr double kLeastClosing = 0.1;

  /// What a step to a state says of the curve between.
  struct Judgement {
    double curvature_error;  ///< with what its begin says
    double wanted_error;     ///< that steps are to have
    double largest_error;    ///< with which it is not taken back
    double finest;           ///< step that is not taken back in any case [m]
    bool is_jump;
    bool is_heavy;  ///< bodies are pressed so much that attraction hardly counts
  };

  PathStatus retract(ForceCurve& curve);
  PathStatus leaveRest(ForceCurve& curve);
  PathStatus goOut(ForceCurve& curve);
  /// Whether the unloading branch is the loading branch; it may be another one after a jump or
  /// flow, under another law, or from another state.
  bool isWayBack() const;
  /// The states of the loading branch from here outwards, but the nearest; empty where the
  /// unloading branch may be another one, or where its first step could not tell the stiffness of
  /// the rest with which `curve` begins.
  std::vector<ForcePoint> wayBack(const ForceCurve& curve) const;
  /// Points of the loading branch into the curve.
  void recordWay(const std::vector<ForcePoint>& way, double end, ForceCurve& curve);
  /// Solves at the height of a point of the loading branch. @return the state, if it has the same
  /// force, and the same energy but for this share
  std::optional<ForcePoint> solveAt(const ForcePoint& target, double same_energy);
  /// The same of a state of the loading branch. @return whether it is the state that is found there
  /// from here
  bool reuse(const ForcePoint& target);
  /// From rest along the loading branch, as far as its largest force or before it. @return whether
  /// the curve has got further
  bool reuseFromRest(ForceCurve& curve);
  /// To the largest force where the loading branch has one summit.
  bool reuseToSummit(ForceCurve& curve);
  /// Where a state is to be solved next to know the largest force of a way whose highest solved
  /// state is `top`; nothing if it is known.
  std::optional<ForcePoint> nextOnSummit(const std::vector<ForcePoint>& way,
                                         const std::optional<ForcePoint>& top) const;
  /// To the last state of the loading branch before its first summit.
  bool reuseTowardsSummit(ForceCurve& curve);
  /// From behind the largest force to the end. @return whether both ways are one there
  bool reuseBehindSummit(ForceCurve& curve);
  /// At rest, where the first step out would change the force by too little to tell it.
  /// @return whether it is known
  bool measureStiffness();
  /// Else takes the stiffness from the first step out.
  void noteStiffness();
  double startHeight() const;
  Accuracy summitAccuracy() const;
  /// That of the state behind a step, where bodies are not pressed heavily.
  Accuracy accuracyOf(bool is_in, double step, const ForceCurve& curve) const;
  /// Solves at a height next to the present state, which must be taken back or accepted then.
  PathStatus attempt(double height, const Accuracy& accuracy, ForcePoint& next,
                     ContactState& state);
  /// The same from where the last attempt ended.
  PathStatus settle(double height, const Accuracy& accuracy, ForcePoint& next, ContactState& state);
  /// Takes back a step to begin the next one with a part of its change.
  void takeBackForPart(const ForcePoint& missed);
  /// The same of one that has missed a force, which the next one leads to.
  void takeBackAndAim(const ForcePoint& missed, double force);
  void accept(const ForcePoint& next, bool is_jump, ForceCurve& curve);
  /// The part of it that takes a step into the curve.
  void record(const ForcePoint& next, bool is_jump, ForceCurve& curve);
  /// The largest force of the present branch over a further change of height, if it went on as it
  /// came [N].
  double continued(double move) const;
  /// Whether the present branch, on the unloading branch, may lead over this force within a step.
  bool mayExceed(double direction, double step, double force) const;
  PathStatus begin(double height);
  /// Where a step's curve falls below `force`, of the step, between `from`, where it is above, and
  /// `to` at most.
  double crossingOf(const StepParabola& parabola, double force, double from, double to) const;
  /// `force`, or as much of it as a step of pressed bodies may lead to.
  double forceWithin(double force) const;
  /// The step to be tried next, but no farther than where the force seems to fall below `force`.
  double stepTo(double force) const;
  /// By how much the mean gap of a periodic frame, which follows the height, may fall at most;
  /// infinity with free edges, whose mean displacement follows instead [m].
  double gapLeft() const;
  /// How far the bodies may close at once on their way to `force` [m].
  double closingStep(double force) const;
  /// On the unloading branch of pressed bodies: the farthest height of the loading branch from
  /// where its curve is smooth enough to here.
  void planStep();
  /// Usual smallest step of a way; and of the present part of it [m].
  double smallestStep(bool is_in) const;
  double leastStep(bool is_in, const ForceCurve& curve) const;
  Judgement judge(const ForcePoint& next, double direction, double step,
                  const ForceCurve& curve) const;
  /// By which factor the next step is to be longer than an accepted one.
  double changeOfStep(const Judgement& judged, bool is_in, int newton_steps) const;
  /// One step in a direction (-1 down, +1 up), no farther than `farthest` [m] and not beyond where
  /// the force falls to `least_force` [N].
  PathStatus advance(double direction, double farthest, double least_force, ForceCurve& curve);
  double forceScale() const;
  /// Force that may be left at rest under `load` [N].
  double leftAtRest(double load) const;
  /// Whether the bodies are pressed so much that attraction hardly counts.
  bool isHeavy(const ForcePoint& point) const;
  double curvatureErrorOf(const ForcePoint& next) const;
  /// Whether no jump lies between the present state and that one, by its energy.
  bool isSmoothTo(const ForcePoint& next) const;
  /// How far the slope at the begin of the step to `next` lies from that at the end of the last
  /// one, over the step and of the force; 0 where there is none to go on from.
  double kinkOf(const ForcePoint& next) const;

  ContactMinimiser& minimiser_;
  PathSettings settings_;
  ForceCurve approach_;
  ForceCurve retraction_;
  ForcePoint present_;
  StepParabola last_parabola_;
  double last_move_ = 0.0;  ///< of Z to the present state [m]; 0: there is none to go on from
  double changing_move_ =
      0.0;                   ///< of Z to the state by whose change the next one begins [m]; 0: none
  double step_ = 0.0;        ///< to be tried next [m]
  double last_error_ = 0.0;  ///< of the last step that was accepted; 0: there was none
  bool is_before_jump_ = false;  ///< the present branch is known to end before jump_height_
  double jump_height_ = 0.0;     ///< [m]
  double finest_ = 0.0;          ///< how close to the jump the branch is to be followed [m]
  double strongest_ = 0.0;       ///< largest attraction so far under the present law [N]
  bool is_over_summit_ = false;  ///< the unloading branch has the largest force
  bool is_on_approach_ =
      true;  ///< the present branch is that of the loading branch, as far as is known
  double changed_energy_ = 0.0;  ///< [J]
  double stiffness_ = std::numeric_limits<double>::quiet_NaN();
  bool is_stiffness_known_ = false;
  double least_force_ = 0.0;  ///< errors of smaller forces do not matter [N]
  double largest_residual_ = 0.0;
  int states_ = 0;
  int newton_steps_ = 0;
  int products_ = 0;
};

}  // namespace mems_stiction
