#include "ros/station_actions.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "evaluation/device_scans.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/scan_flags.hpp"
#include "ros/message_parts.hpp"
#include "ros/station_conversion.hpp"
#include "ros/topic_names.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

template <typename Action>
RunControl controlOf(LongRun<Action>& run) {
  RunControl control;
  control.cancel = &run.cancel();
  control.progress = [&run](int done, int total) {
    typename LongRun<Action>::Feedback feedback;
    feedback.done = static_cast<std::uint32_t>(done);
    feedback.total = static_cast<std::uint32_t>(total);
    run.publishFeedback(feedback);
  };
  return control;
}

/// The goal was cancelled.
struct Cancelled {};

/// Of the device, under several loads.
/// @throw Cancelled
std::vector<LoadedScale> scalesOf(const StationCase& scan, const std::vector<LoadOptions>& loads,
                                  const KnownDevice& known, const std::atomic<bool>& cancel) {
  const auto go_on = [&cancel] {
    if (cancel) throw Cancelled();
  };
  const BesideWork beside(go_on);
  return scalesUnder(
      loads, scan.scan, *scan.settings, [&](double) { go_on(); }, known(scan));
}

}  // namespace

StationActions::StationActions(const ros::NodeHandle& private_handle, double max_goal_size,
                               FindCase find_case, KnownDevice known_device)
    : find_case_(std::move(find_case)),
      known_device_(std::move(known_device)),
      sweep_(private_handle, kSweepLoadAction, max_goal_size,
             [this](const auto& goal, auto& result) { return sweep(goal, result); }),
      cycle_(private_handle, kCycleContactAction, max_goal_size,
             [this](const auto& goal, auto& result) { return cycle(goal, result); }) {}

void StationActions::start() {
  sweep_.start();
  cycle_.start();
}

void StationActions::stop() {
  sweep_.stop();
  cycle_.stop();
}

bool StationActions::sweep(const SweepLoadGoal& goal, SweepLoadResult& result) {
  result.pull_in_voltage = result.site_x = result.site_y = std::numeric_limits<double>::quiet_NaN();
  if (sweep_.cancel()) return false;
  const StationCase station_case = find_case_(goal.height, goal.scan_info);
  result.header = station_case.header;
  const Configuration& settings = *station_case.settings;
  LoadSweepRequest request;
  request.voltages = goal.voltages;
  request.mechanical_loads = goal.mechanical_loads;
  const Options model = onFrame(settings.model, settings.device, station_case.scan.surfaces);
  if (request.mechanical_loads.empty()) request.mechanical_loads = {model.load.mechanical_load};
  std::vector<LoadedScale> scales;
  try {  // a request that is refused is refused at once
    scales = scalesOf(station_case, request.loadsOfDevice(model), known_device_, sweep_.cancel());
  } catch (const Cancelled&) {
    return false;
  }
  const LoadSweepResult swept = sweepLoads(model, station_case.scan.model_surfaces, request,
                                           settings.device, settings.uncertainty, controlOf(sweep_),
                                           scales, measuredScan(station_case.scan, settings.model));
  result = sweepMessage(swept);
  result.header = station_case.header;
  fillProvenance(provenanceOf(station_case.identity, settings), result);
  return swept.is_complete;
}

bool StationActions::cycle(const CycleContactGoal& goal, CycleContactResult& result) {
  result.site_x = result.site_y = std::numeric_limits<double>::quiet_NaN();
  if (cycle_.cancel()) return false;
  const StationCase station_case = find_case_(goal.height, goal.scan_info);
  result.header = station_case.header;
  const Configuration& settings = *station_case.settings;
  const Options model = onFrame(settings.model, settings.device, station_case.scan.surfaces);
  std::vector<LoadedScale> scales;
  try {
    if (goal.count > 0)
      scales = scalesOf(station_case, {model.load}, known_device_, cycle_.cancel());
  } catch (const Cancelled&) {
    return false;
  }
  constexpr std::uint32_t kMost = std::numeric_limits<int>::max();
  const ContactCyclesResult cycled = cycleContacts(
      model, station_case.scan.model_surfaces, static_cast<int>(std::min(goal.count, kMost)),
      settings.device, settings.uncertainty, controlOf(cycle_), scales,
      measuredScan(station_case.scan, settings.model));
  result = cyclesMessage(cycled);
  result.header = station_case.header;
  fillProvenance(provenanceOf(station_case.identity, settings), result);
  return cycled.is_complete;
}

}  // namespace mems_stiction
