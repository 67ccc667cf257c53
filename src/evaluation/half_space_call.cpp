#include "evaluation/half_space_call.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "errors/short_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "mems_stiction/verdict/evidence.hpp"
#include "prediction/contact_solvers.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

/// As verdicts have it: who states less than that is told what is missing.
bool isJudged(const DeviceOptions& device) {
  return (device.hasSpring() && device.contact_area > 0.0) || device.hasBeam();
}

std::int64_t pixelsOf(const HeightMap& frame) {
  return static_cast<std::int64_t>(frame.rows()) * frame.cols();
}

std::string tooLarge(const HeightMap& frame, int most) {
  return "a frame of " + std::to_string(frame.rows()) + " x " + std::to_string(frame.cols()) +
         " pixels is larger than half_space/max_flagged_pixels = " + std::to_string(most) +
         ": scan a smaller area, or ask for it (--half-space, half_space/enabled true, "
         "~solve_half_space)";
}

/// Of a smaller frame than the largest as many more as each takes less.
std::int64_t mostProducts(std::int64_t pixels, const HalfSpaceOptions& options) {
  return static_cast<std::int64_t>(static_cast<double>(options.max_flagged_products) *
                                   options.max_flagged_pixels / static_cast<double>(pixels));
}

std::string tooLong(std::int64_t pixels, const HalfSpaceOptions& options) {
  return "its solution takes more than " + std::to_string(mostProducts(pixels, options)) +
         " products (half_space/max_flagged_products = " +
         std::to_string(options.max_flagged_products) +
         "): ask for it (--half-space, half_space/enabled true, ~solve_half_space)";
}

/// Why there is no use in asking; empty if there may be.
std::string objectionTo(const HalfSpaceProblem& problem, const HalfSpaceOptions& options) {
  const HeightMap& frame = problem.surfaces.lower;
  if (options.path == HalfSpacePath::kRest) return kRestAlone;
  if (problem.may_tilt) return kMayTilt;
  if (pixelsOf(frame) > options.max_flagged_pixels)
    return tooLarge(frame, options.max_flagged_pixels);
  try {
    return isResolved(problem, options) ? "" : kPixelsTooLarge;
  } catch (const Error& error) {
    return error.what();
  }
}

/// Ends a solution after so many products, or when its caller does.
class Bound {
 public:
  Bound(const HalfSpaceControl& control, std::int64_t most) : control_(control), most_(most) {}

  HalfSpaceControl control() {
    HalfSpaceControl bounded = control_;
    bounded.cancel = &ended_;
    bounded.give_way = [this] {
      if (control_.give_way) control_.give_way();
      if (++products_ > most_ || (control_.cancel != nullptr && *control_.cancel)) ended_ = true;
    };
    return bounded;
  }
  bool isReached() const { return products_ > most_; }

 private:
  const HalfSpaceControl& control_;
  std::int64_t most_;
  std::int64_t products_ = 0;
  std::atomic<bool> ended_{false};
};

}  // namespace

bool mayCallHalfSpace(const Configuration& configuration) {
  switch (configuration.half_space.enabled) {
    case HalfSpaceUse::kNever:
      return false;
    case HalfSpaceUse::kFlagged:
      return isJudged(configuration.device) &&
             skillsOf(configuration.model.formulation).calls_half_space;
    case HalfSpaceUse::kAlways:
      break;
  }
  return true;
}

HalfSpaceCall halfSpaceCall(const Prediction& prediction, const PreparedScan& prepared,
                            const Options& options, const Configuration& configuration) {
  HalfSpaceCall call;
  if (!mayCallHalfSpace(configuration)) return call;
  call.is_made = true;
  if (configuration.half_space.enabled == HalfSpaceUse::kAlways) return call;
  call.why = regimeFlagNames(
      flagsForHalfSpace(regimeFlags(prediction, prepared.surfaces.lower.cellArea())));
  call.is_made = !call.why.empty();
  if (call.is_made)
    call.objection = objectionTo(halfSpaceProblem(prepared, options), configuration.half_space);
  return call;
}

std::string coarsePixelsWarning(const PreparedScan& prepared, const Options& options,
                                const HalfSpaceOptions& half_space) {
  const HeightMap& frame = prepared.model_surfaces.lower;
  const double pitch = std::max(frame.pitchX(), frame.pitchY());
  try {
    const double largest = resolvingPitch(halfSpaceProblem(prepared, options), half_space);
    if (pitch <= largest) return "";
    return "half-space: pixels of " + shortNumber(pitch) +
           " m are too large for the edges of the contacts: forces come out too large as a rule, "
           "and soft bodies may take minutes and end TOO_MANY_STATES; scan a smaller area with "
           "pixels of " +
           shortNumber(largest) + " m or less";
  } catch (const OptionsError&) {  // the solution says so
    return "";
  }
}

SolvedHalfSpace answerOf(const HalfSpaceCall& call, const HalfSpaceSolver& solver,
                         const HalfSpaceProblem& problem, const HalfSpaceControl& control) {
  if (call.why.empty()) return solver.solve(problem, control);
  if (!call.objection.empty()) return unsolvedHalfSpace(call.objection);
  const std::int64_t pixels = pixelsOf(problem.surfaces.lower);
  Bound bound(control, mostProducts(pixels, solver.options()));
  try {
    SolvedHalfSpace solution = solver.solve(problem, bound.control());
    const bool is_ended = control.cancel != nullptr && *control.cancel;
    if (solution.status == HalfSpaceStatus::kCancelled && bound.isReached() && !is_ended) {
      solution.message = tooLong(pixels, solver.options());
    }
    return solution;
  } catch (const Error& error) {
    return unsolvedHalfSpace(error.what());
  }
}

}  // namespace mems_stiction
