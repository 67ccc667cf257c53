#pragma once

/// @file
/// The long runs of a test station, ~sweep_load and ~cycle_contact, each with surfaces and settings
/// of its own.

#include <functional>
#include <optional>

#include <ros/node_handle.h>

#include "mems_stiction/CycleContactAction.h"
#include "mems_stiction/SweepLoadAction.h"
#include "ros/live_predictor.hpp"
#include "ros/long_run.hpp"

namespace mems_stiction {

/// The scan of a goal, or the last one if the image has no pixels. May throw; what() is the
/// client's answer.
using FindCase = std::function<StationCase(const sensor_msgs::Image& height, const ScanInfo& info)>;

/// The device's figures beside those of the scan, if they are known.
using KnownDevice = std::function<std::optional<DeviceScale>(const StationCase& scan)>;

/// Both action servers. A run whose device is not known finds it first, by its scan alone.
class StationActions {
 public:
  StationActions(const ros::NodeHandle& private_handle, double max_goal_size, FindCase find_case,
                 KnownDevice known_device);

  void start();
  /// Ends what runs after its present step; it is then aborted.
  void stop();

 private:
  bool sweep(const SweepLoadGoal& goal, SweepLoadResult& result);
  bool cycle(const CycleContactGoal& goal, CycleContactResult& result);

  FindCase find_case_;
  KnownDevice known_device_;
  LongRun<SweepLoadAction> sweep_;
  LongRun<CycleContactAction> cycle_;
};

}  // namespace mems_stiction
