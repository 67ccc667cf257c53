#pragma once

/// @file
/// The long runs of a test station, ~sweep_load and ~cycle_contact, each with surfaces and settings
/// of its own.

#include <functional>
#include <optional>

#include <ros/node_handle.h>

#include "evaluation/device_scans.hpp"
#include "mems_stiction/CycleContactAction.h"
#include "mems_stiction/SweepLoadAction.h"
#include "ros/live_predictor.hpp"
#include "ros/long_run.hpp"

namespace mems_stiction {

/// The scan of a goal, or the last one if the image has no pixels. May throw; what() is the
/// client's answer.
using FindCase = std::function<StationCase(const sensor_msgs::Image& height, const ScanInfo& info)>;

/// All scans of the device that a scan is of, if its force was found.
using KnownDevice = std::function<std::optional<DeviceScans>(const StationCase& scan)>;

/// Both action servers. The device's own force is found before a run, by the scan alone where no
/// other is known.
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
