#include "ros/half_space_calls.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <memory>
#include <utility>

#include "evaluation/frame_load.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "ros/background_thread.hpp"
#include "ros/checked_messages.hpp"
#include "ros/half_space_conversion.hpp"
#include "ros/message_parts.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {
namespace {

static_assert(static_cast<int>(HalfSpaceFeedback::APPROACH) == HalfSpacePoint::APPROACH, "phase");
static_assert(static_cast<int>(HalfSpaceFeedback::RETRACTION) == HalfSpacePoint::RETRACTION,
              "phase");

constexpr std::uint32_t kServiceThreads = 1;
constexpr std::chrono::milliseconds kFeedbackPeriod{50};

/// How far the path is. Where it will come to rest is not known on the way down, where the share
/// approaches a half.
class PathProgress {
 public:
  HalfSpaceFeedback after(const ForcePoint& point) {
    HalfSpaceFeedback feedback;
    if (!has_begun_) start_ = lowest_ = point.height;
    has_begun_ = true;
    const bool comes_down = point.height <= lowest_;
    lowest_ = std::min(lowest_, point.height);
    const double fallen = start_ - lowest_;
    if (comes_down) {
      progress_ = 0.5 * fallen / (fallen + start_);
    } else {
      progress_ = std::clamp(0.5 + 0.5 * (point.height - lowest_) / fallen, progress_, 1.0);
    }
    feedback.phase = comes_down ? HalfSpaceFeedback::APPROACH : HalfSpaceFeedback::RETRACTION;
    feedback.progress = progress_;
    feedback.height = point.height;
    feedback.force = point.force;
    return feedback;
  }

 private:
  bool has_begun_ = false;
  double start_ = 0.0;   ///< where nothing touches [m], > 0
  double lowest_ = 0.0;  ///< so far [m]
  double progress_ = 0.0;
};

}  // namespace

HalfSpaceCalls::HalfSpaceCalls(const ros::NodeHandle& private_handle,
                               const HalfSpaceOptions& options, double max_message_size,
                               SolutionPause& pause, FindCase find_case, Beside beside)
    : solver_(options),
      pause_(pause),
      find_case_(std::move(find_case)),
      beside_(std::move(beside)),
      action_(private_handle, kHalfSpaceAction, max_message_size,
              [this](const auto& goal, auto& result) { return run(goal, result); }),
      handle_(private_handle),
      spinner_(kServiceThreads, &queue_) {
  handle_.setCallbackQueue(&queue_);
  service_ = advertiseChecked<SolveHalfSpace>(
      handle_, kSolveHalfSpaceService,
      {[this](auto& request, auto& response) { serve(request, response); },
       [](auto& response, const std::string& reason) {
         response.solution = refusedMessage(reason, LoadOptions(), std_msgs::Header());
         response.message = response.solution.message;
       },
       max_message_size});
}

HalfSpaceCalls::~HalfSpaceCalls() {
  stop();
  spinner_.stop();
}

void HalfSpaceCalls::start() {
  action_.start();
  spinner_.start();
}

void HalfSpaceCalls::stop() {
  stopping_ = true;
  action_.stop();
}

template <typename Asked>
HalfSpaceSolution HalfSpaceCalls::solve(const Asked& asked, const HalfSpaceControl& control) {
  yieldToOtherThreads();
  std_msgs::Header header = asked.height.header;
  Provenance provenance;
  LoadOptions load;
  load.voltage = asked.voltage;
  load.mechanical_load = asked.mechanical_load;
  const auto refused = [&](const std::string& reason) {
    HalfSpaceSolution message = refusedMessage(reason, load, header);
    fillProvenance(provenance, message);
    return message;
  };
  try {
    StationCase station_case = find_case_(asked.height, asked.scan_info);
    header = station_case.header;
    Configuration settings = *station_case.settings;
    if (!std::isnan(asked.voltage)) settings.model.load.voltage = asked.voltage;
    if (!std::isnan(asked.mechanical_load))
      settings.model.load.setMechanicalLoad(asked.mechanical_load);
    provenance = provenanceOf(station_case.identity, settings);
    station_case.settings = std::make_shared<const Configuration>(
        settings);  // what is known of the device is of a load
    const Options options = onFrame(settings.model, settings.device, station_case.scan.surfaces);
    load = options.load;
    options.check();
    const SolvedHalfSpace solved =
        solver_.solve(halfSpaceProblem(station_case.scan, options), control);
    HalfSpaceSolution message = halfSpaceMessage(solved, load, header);
    fillProvenance(provenance, message);
    if (solved.status != HalfSpaceStatus::kCancelled) {
      fillVerdict(
          halfSpaceVerdict(solved, station_case.scan, options, settings, beside_(station_case)),
          message);
    }
    return message;
  } catch (const std::future_error&) {
    return refused(kShuttingDown);
  } catch (const std::exception& error) {
    return refused(error.what());
  }
}

void HalfSpaceCalls::serve(SolveHalfSpace::Request& request, SolveHalfSpace::Response& response) {
  HalfSpaceControl control;
  control.cancel = &stopping_;
  control.give_way = pause_.waiter(stopping_);
  response.solution = solve(request, control);
  response.success = response.solution.status == HalfSpaceSolution::SOLVED;
  response.message = stopping_ ? kShuttingDown : response.solution.message;
}

bool HalfSpaceCalls::run(const HalfSpaceGoal& goal, HalfSpaceResult& result) {
  PathProgress progress;
  std::chrono::steady_clock::time_point told;
  HalfSpaceControl control;
  control.cancel = &action_.cancel();
  control.give_way = pause_.waiter(action_.cancel());
  control.on_state = [&](const ForcePoint& point) {
    const HalfSpaceFeedback feedback = progress.after(point);
    const auto now = std::chrono::steady_clock::now();
    if (now - told < kFeedbackPeriod) return;
    told = now;
    action_.publishFeedback(feedback);
  };
  result.solution = solve(goal, control);
  const bool is_solved = result.solution.status == HalfSpaceSolution::SOLVED;
  if (!is_solved && result.solution.status != HalfSpaceSolution::CANCELLED)
    result.message = result.solution.message;
  return is_solved;
}

}  // namespace mems_stiction
