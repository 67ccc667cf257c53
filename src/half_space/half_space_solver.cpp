#include "mems_stiction/half_space/half_space_solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "approach/gap_field.hpp"
#include "deformation/modified_topography.hpp"
#include "errors/short_number.hpp"
#include "half_space/cell_influence.hpp"
#include "half_space/contact_groups.hpp"
#include "half_space/contact_minimiser.hpp"
#include "half_space/contact_path.hpp"
#include "half_space/half_space_grid.hpp"
#include "half_space/row_work.hpp"
#include "half_space/traction_law.hpp"
#include "height_map/validity.hpp"
#include "loads/force_range.hpp"
#include "mechanics/wave_stiffness.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"

namespace mems_stiction {
namespace {

/// Pixels that the cohesive length must have.
constexpr double kPixelsPerCohesiveLength = 2.0;
/// Pull-off forces that finer steps change by less than this are converged in the step.
constexpr double kStepConvergence = 0.02;

/// That of an equilibrium: finer steps differ by less force, which residuals must not hide.
double toleranceOf(const HalfSpaceOptions& options) {
  const double share = options.step / ContactPath::kUsualStep;
  return std::min(options.tolerance,
                  std::max(HalfSpaceOptions::kFinestTolerance, share * options.tolerance));
}

/// What a frame with free edges cannot have on its other side.
void checkBacking(const Material& body, const std::string& name, const HeightMap& frame,
                  std::vector<std::string>& violations) {
  if (body.thickness == 0.0) return;
  const std::string thickness =
      name + "/thickness: " + numberText(body.thickness) + " m with half_space/boundary free ";
  const double thinnest = CellInfluence::kThinnestFilm * std::max(frame.pitchX(), frame.pitchY());
  if (body.backing == Backing::kFree) {
    violations.push_back(thickness + "and " + name +
                         "/backing free is not allowed: how far a plate bends under a contact "
                         "depends on where it is "
                         "held; must be 0 m, or the boundary periodic");
  } else if (body.thickness < thinnest) {
    violations.push_back(thickness + "is not allowed: too thin for pixels of " +
                         numberText(thinnest / CellInfluence::kThinnestFilm) +
                         " m; must be >= " + numberText(thinnest) + " m, or the boundary periodic");
  }
}

void check(const HalfSpaceProblem& problem, const HalfSpaceOptions& options,
           const TractionLawOptions& law) {
  OptionValidator validator;
  describeConst(problem.lower_material, validator, "lower");
  describeConst(problem.upper_material, validator, "upper");
  describeConst(problem.interface, validator);
  describeConst(problem.load, validator);
  std::vector<std::string> violations = validator.violations();
  const std::vector<std::string> of_law = law.validate();
  violations.insert(violations.end(), of_law.begin(), of_law.end());
  for (const auto& [name, body] :
       {std::pair("lower", &problem.lower_material), std::pair("upper", &problem.upper_material)}) {
    for (std::string& contradiction : body->contradictions(name))
      violations.push_back(std::move(contradiction));
  }
  for (std::string& contradiction :
       filmContradictions(problem.interface, problem.lower_material, problem.upper_material)) {
    violations.push_back(std::move(contradiction));
  }
  if (violations.empty() && options.boundary == HalfSpaceBoundary::kFree) {
    checkBacking(problem.lower_material, "lower", problem.surfaces.lower, violations);
    checkBacking(problem.upper_material, "upper", problem.surfaces.lower, violations);
  }
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

TractionLawOptions lawOptions(const HalfSpaceOptions& options, const HalfSpaceProblem& problem) {
  TractionLawOptions law;
  law.work_of_adhesion = problem.interface.work_of_adhesion;
  law.hamaker_constant = problem.interface.hamaker_constant;
  law.lower = coatedBody(problem.lower_material);
  law.upper = coatedBody(problem.upper_material);
  law.retardation_length = problem.interface.retardation_length;
  law.range = options.range;
  law.attracts = options.attraction;
  if (options.flow)
    law.hardness = std::min(problem.lower_material.hardness, problem.upper_material.hardness);
  law.voltage = problem.load.fieldVoltage();
  law.insulator_thickness = problem.interface.insulator_thickness;
  law.insulator_relative_permittivity = problem.interface.insulator_relative_permittivity;
  law.water = problem.capillary;
  return law;
}

/// E z0^2/Gamma, or that of water, which pulls with p over d: E d/p [m].
double cohesiveLength(const HalfSpaceProblem& problem, const TractionLaw& law) {
  const ContactPair pair(problem.lower_material, problem.upper_material);
  const WaterLaw water = problem.capillary.law();
  const double dry = law.range() * law.range() / problem.interface.work_of_adhesion;
  const double wet = water.isOn() ? water.gapLimit() / water.pressure() : dry;
  return pair.contact_modulus * std::min(dry, wet);
}

/// The composite gap at first touch, infinite where it is not known.
LargePageVector<double> reliefOf(const SurfacePair& surfaces, int threads) {
  GapField field;
  field.compute(surfaces);
  LargePageVector<double> relief(static_cast<std::size_t>(field.cellCount()));
  const auto cols = static_cast<std::size_t>(field.cols());
  forEachRow(field.rows(), threads, [&](int row) {
    field.gapsOfRow(row, relief.data() + static_cast<std::size_t>(row) * cols);
  });
  return relief;
}

/// The heights less what flowed of them, times `share`.
HeightMap deformed(const HeightMap& surface, const LargePageVector<float>& flowed, double share) {
  cv::Mat heights = ownedHeights(surface);
  for (int row = 0; row < heights.rows && !flowed.empty(); ++row) {
    const float* const lost =
        flowed.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(heights.cols);
    double* const height = heights.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col)
      height[col] -= share * static_cast<double>(lost[col]);
  }
  return HeightMap(heights, surface.pitchX(), surface.pitchY());
}

double largestPitch(const HalfSpaceProblem& problem) {
  return std::max(problem.surfaces.lower.pitchX(), problem.surfaces.lower.pitchY());
}

/// What to do about a path of too many states.
std::string adviceOn(const HalfSpaceProblem& problem, const HalfSpaceOptions& options,
                     const SolvedHalfSpace& solution) {
  if (!options.attraction) {
    return "the repulsion is too steep for states as exact as these: state a smaller "
           "half_space/tolerance, or a longer half_space/range than " +
           numberText(solution.range) + " m";
  }
  if (solution.is_resolved) return "raise it";
  return "pixels of " + shortNumber(largestPitch(problem)) +
         " m do not resolve the edges of the contacts, which jump from pixel to pixel: scan a "
         "smaller area with pixels of " +
         shortNumber(solution.cohesive_length / kPixelsPerCohesiveLength) + " m or less";
}

std::string sentenceOf(PathStatus status, const HalfSpaceProblem& problem,
                       const HalfSpaceOptions& options, const ContactPath& path,
                       const SolvedHalfSpace& solution) {
  const std::string where = "at height " + numberText(path.present().height) + " m";
  switch (status) {
    case PathStatus::kDone:
      return options.path == HalfSpacePath::kRest
                 ? "came to rest: half_space/path rest knows no pull-off force"
                 : "came to rest and came apart";
    case PathStatus::kLoadNotReached:
      return "load/mechanical_load of " + numberText(problem.load.mechanical_load) +
             " N is not reached: the surfaces carry no more than " +
             numberText(path.largestLoad()) + " N";
    case PathStatus::kNotConverged:
      return "no equilibrium within half_space/max_newton_steps = " +
             std::to_string(options.max_newton_steps) + " next to the one " + where;
    case PathStatus::kTooManyStates:
      return "half_space/max_states = " + std::to_string(options.max_states) +
             " did not suffice; the path ends " + where + "; " +
             adviceOn(problem, options, solution);
    case PathStatus::kCancelled:
      break;
  }
  return "cancelled " + where;
}

HalfSpaceStatus statusOf(PathStatus status) {
  switch (status) {
    case PathStatus::kDone:
      return HalfSpaceStatus::kSolved;
    case PathStatus::kLoadNotReached:
      return HalfSpaceStatus::kLoadNotReached;
    case PathStatus::kNotConverged:
      return HalfSpaceStatus::kNotConverged;
    case PathStatus::kTooManyStates:
      return HalfSpaceStatus::kTooManyStates;
    case PathStatus::kCancelled:
      break;
  }
  return HalfSpaceStatus::kCancelled;
}

/// What the state at rest says.
void takeRest(const ContactPath& path, const ContactMinimiser& minimiser,
              SolvedHalfSpace& solution) {
  const ForcePoint& rest = path.present();
  solution.rest_height = rest.height;
  solution.rest_force = rest.force;
  solution.contact_area = rest.contact_area;
  solution.contact_fraction = rest.contact_area / minimiser.validArea();
  solution.mean_gap = rest.mean_gap;
  minimiser.maps(rest.height, solution.gap, solution.pressure);
  const cv::Mat contact = solution.gap < minimiser.law().contactGap();
  solution.contact_count =
      countContactGroups(contact, minimiser.grid().boundary == HalfSpaceBoundary::kPeriodic);
}

/// What the whole path says.
void takePath(const ContactPath& path, double area, SolvedHalfSpace& solution) {
  const ForceCurve& retraction = path.retractionCurve();
  const ForceCurve& approach = path.approachCurve();
  solution.pull_off_force = retraction.largest_force;
  solution.pull_off_height = retraction.largest_height;
  solution.pull_off_uncertainty = retraction.missed_force;
  solution.is_step_converged =
      retraction.missed_force < kStepConvergence * retraction.largest_force;
  solution.work_of_adhesion = (retraction.attracting_work - retraction.points.back().energy) / area;
  const double both_ways = retraction.work - retraction.points.back().energy + approach.work +
                           approach.points.front().energy + path.changedEnergy();
  solution.hysteresis = both_ways / area;
}

/// The unloading branch from rest, when the voltage has gone; and, where there was one, a second
/// one under it. A contact potential stays on both.
/// - @p law of the loading branch
/// - @p flowed on the first one
PathStatus partFromRest(ContactPath& path, const ContactMinimiser& minimiser,
                        TractionLawOptions law, const LoadOptions& load,
                        LargePageVector<float>& flowed, SolvedHalfSpace& solution) {
  const bool has_voltage = load.voltage != 0.0;
  std::optional<ContactPath::Place> rest;
  PathStatus status = PathStatus::kDone;
  if (has_voltage) {
    rest = path.place();
    law.voltage = load.contact_potential;
    status = path.change(TractionLaw(law));
  }
  if (status == PathStatus::kDone) status = path.retract();
  solution.contact_stiffness = path.stiffness();
  flowed = minimiser.flowed();
  if (status != PathStatus::kDone) return status;
  takePath(path, minimiser.validArea(), solution);
  solution.pull_off_force_under_voltage = solution.pull_off_force;
  if (!has_voltage) return status;
  ForceCurve under_voltage;
  const bool came_apart = path.retractFrom(std::move(*rest), under_voltage) == PathStatus::kDone;
  solution.pull_off_force_under_voltage =
      came_apart ? under_voltage.largest_force : SolvedHalfSpace::kNone;
  return status;
}

/// The first step of the unloading branch, for the stiffness at rest; rest is solved whether it has
/// one or not.
PathStatus leaveRest(ContactPath& path, const ContactMinimiser& minimiser,
                     LargePageVector<float>& flowed, SolvedHalfSpace& solution) {
  const PathStatus status = path.leaveRest();
  flowed = minimiser.flowed();
  solution.contact_stiffness = path.stiffness();
  return status == PathStatus::kCancelled ? status : PathStatus::kDone;
}

/// Every state that was solved, and what it took.
void takeRecord(const ContactPath& path, HalfSpacePath asked, SolvedHalfSpace& solution) {
  solution.path = asked;
  solution.approach = path.approachCurve().points;
  solution.jumps = path.approachCurve().jumps;
  if (asked == HalfSpacePath::kWhole) {
    solution.retraction = path.retractionCurve().points;
    solution.jumps += path.retractionCurve().jumps;
  }
  solution.residual = path.largestResidual();
  solution.state_count = path.stateCount();
  solution.newton_steps = path.newtonSteps();
  solution.products = path.products();
}

/// The surfaces after contact: what flowed is shared by the bodies as (12) says.
void takeSurfaces(const HalfSpaceProblem& problem, const LargePageVector<float>& flowed,
                  SolvedHalfSpace& solution) {
  const DeformationShare share(problem.lower_material, problem.upper_material,
                               problem.interface.hardness_ratio_limit);
  double depth = 0.0;
  for (const float lost : flowed) depth += static_cast<double>(lost);
  const HeightMap& lower = problem.surfaces.lower;
  solution.flowed_volume = depth * lower.cellArea();
  solution.deformed_lower = deformed(lower, flowed, share.lower(kPlasticLimit));
  const double upper_share = share.upper(kPlasticLimit);
  if (!problem.surfaces.upperIsPlane()) {
    solution.deformed_upper = deformed(problem.surfaces.upper, flowed, -upper_share);
  } else if (!flowed.empty() && upper_share > 0.0) {
    const cv::Mat plane = cv::Mat::zeros(lower.rows(), lower.cols(), CV_64FC1);
    solution.deformed_upper =
        deformed(HeightMap(plane, lower.pitchX(), lower.pitchY()), flowed, -upper_share);
  }
}

}  // namespace

double resolvingPitch(const HalfSpaceProblem& problem, const HalfSpaceOptions& options) {
  const TractionLawOptions law_options = lawOptions(options, problem);
  check(problem, options, law_options);
  return cohesiveLength(problem, TractionLaw(law_options)) / kPixelsPerCohesiveLength;
}

bool isResolved(const HalfSpaceProblem& problem, const HalfSpaceOptions& options) {
  return largestPitch(problem) <= resolvingPitch(problem, options);
}

HalfSpaceSolver::HalfSpaceSolver(const HalfSpaceOptions& options) : options_(options) {
  std::vector<std::string> violations = rangeViolations(options);
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

SolvedHalfSpace HalfSpaceSolver::solve(const HalfSpaceProblem& problem,
                                       const HalfSpaceControl& control) const {
  const auto begin = std::chrono::steady_clock::now();
  const TractionLawOptions law_options = lawOptions(options_, problem);
  check(problem, options_, law_options);
  const HeightMap& lower = problem.surfaces.lower;
  if (lower.empty()) throw SurfaceError("the height map has no valid pixel");
  const auto pixels =
      static_cast<std::size_t>(lower.rows()) * static_cast<std::size_t>(lower.cols());
  if (pixels > static_cast<std::size_t>(options_.max_pixels)) {
    throw SurfaceError(
        "a frame of " + std::to_string(lower.rows()) + " x " + std::to_string(lower.cols()) +
        " pixels is larger than half_space/max_pixels = " + std::to_string(options_.max_pixels));
  }
  const ContactPair pair(problem.lower_material, problem.upper_material);
  const WaveStiffness layers(problem.lower_material, problem.upper_material);
  const ElasticResponse response{pair.contact_modulus, nullptr,
                                 layers.isThick() ? nullptr : &layers};
  const TractionLaw law(law_options);
  const HalfSpaceGrid grid(lower.rows(), lower.cols(), lower.pitchX(), lower.pitchY(),
                           options_.boundary);
  MinimiserSettings minimiser_settings;
  minimiser_settings.tolerance = toleranceOf(options_);
  minimiser_settings.max_newton_steps = options_.max_newton_steps;
  minimiser_settings.threads = options_.threads;
  minimiser_settings.cancel = control.cancel;
  minimiser_settings.give_way = control.give_way;
  PathSettings path_settings;
  path_settings.step = options_.step;
  path_settings.samples_curve = options_.path == HalfSpacePath::kWhole;
  path_settings.max_states = options_.max_states;
  path_settings.on_state = control.on_state;

  SolvedHalfSpace solution;
  solution.range = law.range();
  solution.may_tilt = problem.may_tilt;
  solution.cohesive_length = cohesiveLength(problem, law);
  solution.is_resolved = !law.attracts() || solution.cohesive_length >=
                                                kPixelsPerCohesiveLength * largestPitch(problem);
  path_settings.is_resolved = solution.is_resolved;
  LargePageVector<float> flowed;
  {
    ContactMinimiser minimiser(grid, law, response, reliefOf(problem.surfaces, options_.threads),
                               minimiser_settings);
    ContactPath path(minimiser, path_settings);
    PathStatus status =
        minimiser.isSetUp() ? path.approach(problem.load.mechanical_load) : PathStatus::kCancelled;
    if (status == PathStatus::kDone) {
      takeRest(path, minimiser, solution);
      status = options_.path == HalfSpacePath::kRest
                   ? leaveRest(path, minimiser, flowed, solution)
                   : partFromRest(path, minimiser, law_options, problem.load, flowed, solution);
    }
    solution.status = statusOf(status);
    solution.is_converged = solution.status == HalfSpaceStatus::kSolved;
    solution.message = sentenceOf(status, problem, options_, path, solution);
    takeRecord(path, options_.path, solution);
  }  // its memory is not needed for the surfaces
  if (solution.status == HalfSpaceStatus::kSolved) takeSurfaces(problem, flowed, solution);
  solution.processing_time =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

}  // namespace mems_stiction
