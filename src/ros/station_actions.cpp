#include "mems_stiction/ros/station_actions.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <limits>
#include <string>
#include <thread>
#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/one_line.hpp"
#include "mems_stiction/ros/station_conversion.hpp"
#include "mems_stiction/ros/topic_names.hpp"

namespace mems_stiction {
namespace {

constexpr bool kNoAutoStart = false;
/// From the arrival of a goal: rospy's SimpleActionClient never hears of an answer that comes before its send_goal has
/// returned, and waits on (https://github.com/ros/actionlib/issues/206). Goals that are refused are answered that soon.
constexpr std::chrono::milliseconds kEarliestAnswer{100};

template <typename Action, typename Feedback>
RunControl controlOf(actionlib::SimpleActionServer<Action>& server, const std::atomic<bool>& cancel,
                     Feedback feedback) {
  RunControl control;
  control.cancel = &cancel;
  control.progress = [&server, feedback](int done, int total) mutable {
    feedback.done = static_cast<std::uint32_t>(done);
    feedback.total = static_cast<std::uint32_t>(total);
    server.publishFeedback(feedback);
  };
  return control;
}

}  // namespace

StationActions::StationActions(const ros::NodeHandle& private_handle, FindCase find_case)
    : find_case_(std::move(find_case)),
      sweep_(
          private_handle, kSweepLoadAction, [this](const auto& goal) { sweep(goal); }, kNoAutoStart),
      cycle_(
          private_handle, kCycleContactAction, [this](const auto& goal) { cycle(goal); }, kNoAutoStart) {
  sweep_.registerPreemptCallback([this] { cancel_sweep_ = true; });
  cycle_.registerPreemptCallback([this] { cancel_cycle_ = true; });
}

void StationActions::start() {
  sweep_.start();
  cycle_.start();
}

void StationActions::stop() {
  stopping_ = true;
  cancel_sweep_ = true;
  cancel_cycle_ = true;
}

template <typename Action, typename Result, typename Work>
void StationActions::answer(Server<Action>& server, std::atomic<bool>& cancel, Result& result, Work work) {
  cancel = false;
  // Whoever asked to end before this goal's flag was cleared is asked again.
  if (stopping_ || server.isPreemptRequested()) cancel = true;
  const auto earliest_answer = std::chrono::steady_clock::now() + kEarliestAnswer;
  bool is_complete = false;
  bool has_failed = false;
  try {
    is_complete = !cancel && work();
    if (!is_complete) result.message = stopping_ ? kShuttingDown : "cancelled";
  } catch (const std::future_error&) {
    result.message = kShuttingDown;
  } catch (const std::exception& error) {
    result.message = oneLine(error.what());
    has_failed = true;
  }
  if (!stopping_) std::this_thread::sleep_until(earliest_answer);
  if (is_complete) {
    server.setSucceeded(result);
  } else if (!has_failed && server.isPreemptRequested()) {
    server.setPreempted(result, result.message);
  } else {
    server.setAborted(result, result.message);
  }
}

void StationActions::sweep(const SweepLoadGoalConstPtr& goal) {
  SweepLoadResult result;
  result.pull_in_voltage = std::numeric_limits<double>::quiet_NaN();
  answer(sweep_, cancel_sweep_, result, [&] {
    const StationCase station_case = find_case_(goal->height, goal->scan_info);
    result.header = station_case.header;
    const Configuration& settings = *station_case.settings;
    LoadSweepRequest request;
    request.voltages = goal->voltages;
    request.mechanical_loads = goal->mechanical_loads;
    if (request.mechanical_loads.empty()) request.mechanical_loads = {settings.model.load.mechanical_load};
    const LoadSweepResult swept =
        sweepLoads(settings.model, station_case.scan.model_surfaces, request, settings.device, settings.uncertainty,
                   controlOf(sweep_, cancel_sweep_, SweepLoadFeedback()));
    result = sweepMessage(swept);
    result.header = station_case.header;
    return swept.is_complete;
  });
}

void StationActions::cycle(const CycleContactGoalConstPtr& goal) {
  CycleContactResult result;
  answer(cycle_, cancel_cycle_, result, [&] {
    const StationCase station_case = find_case_(goal->height, goal->scan_info);
    result.header = station_case.header;
    const Configuration& settings = *station_case.settings;
    constexpr std::uint32_t kMost = std::numeric_limits<int>::max();
    const ContactCyclesResult cycled =
        cycleContacts(settings.model, station_case.scan.model_surfaces, static_cast<int>(std::min(goal->count, kMost)),
                      settings.device, settings.uncertainty, controlOf(cycle_, cancel_cycle_, CycleContactFeedback()));
    result = cyclesMessage(cycled);
    result.header = station_case.header;
    return cycled.is_complete;
  });
}

}  // namespace mems_stiction
