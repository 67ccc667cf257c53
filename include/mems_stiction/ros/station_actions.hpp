#pragma once

/// @file
/// The long runs of a test station, ~sweep_load and ~cycle_contact. Each goal runs on a thread of its own with surfaces
/// and settings of its own, so that live scans go on; a new goal takes the place of the one that runs.

#include <atomic>
#include <functional>

#include <actionlib/server/simple_action_server.h>
#include <ros/node_handle.h>

#include "mems_stiction/CycleContactAction.h"
#include "mems_stiction/SweepLoadAction.h"
#include "mems_stiction/ros/live_predictor.hpp"

namespace mems_stiction {

/// Both action servers.
class StationActions {
 public:
  /// The scan of a goal, or the last one if the image has no pixels. May throw; what() is the client's answer.
  using FindCase = std::function<StationCase(const sensor_msgs::Image& height, const ScanInfo& info)>;

  StationActions(const ros::NodeHandle& private_handle, FindCase find_case);
  ~StationActions() { stop(); }

  void start();
  /// Ends what runs after its present step; it is then aborted.
  void stop();

 private:
  template <typename Action>
  using Server = actionlib::SimpleActionServer<Action>;

  void sweep(const SweepLoadGoalConstPtr& goal);
  void cycle(const CycleContactGoalConstPtr& goal);
  /// Runs `work`, which fills the result and returns whether it came to its end, and answers the client.
  template <typename Action, typename Result, typename Work>
  void answer(Server<Action>& server, std::atomic<bool>& cancel, Result& result, Work work);

  FindCase find_case_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> cancel_sweep_{false};
  std::atomic<bool> cancel_cycle_{false};
  Server<SweepLoadAction> sweep_;
  Server<CycleContactAction> cycle_;
};

}  // namespace mems_stiction
