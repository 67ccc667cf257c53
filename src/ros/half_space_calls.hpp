#pragma once

/// @file
/// The half-space of one scan on demand: the service ~solve_half_space, which waits for the answer,
/// and the action ~half_space with progress and cancel. Each has a thread of its own, so that
/// neither predictions nor other services wait for it; one call and one goal at a time.

#include <atomic>
#include <functional>

#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "half_space/solution_pause.hpp"
#include "mems_stiction/HalfSpaceAction.h"
#include "mems_stiction/HalfSpaceSolution.h"
#include "mems_stiction/SolveHalfSpace.h"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "ros/guarded_queue.hpp"
#include "ros/long_run.hpp"
#include "ros/station_actions.hpp"

namespace mems_stiction {

/// Service and action.
class HalfSpaceCalls {
 public:
  /// What is known of the device of a scan, called on the threads of the calls.
  using Beside = std::function<Evidence(const StationCase& scan)>;

  /// - @p pause is given way to; it must outlive the calls
  HalfSpaceCalls(const ros::NodeHandle& private_handle, const HalfSpaceOptions& options,
                 double max_message_size, SolutionPause& pause, FindCase find_case, Beside beside);
  ~HalfSpaceCalls();
  HalfSpaceCalls(const HalfSpaceCalls&) = delete;
  HalfSpaceCalls& operator=(const HalfSpaceCalls&) = delete;

  void start();
  /// Ends what runs after its present transform; it is answered as cancelled.
  void stop();

 private:
  /// - @p asked goal or request, which have the same fields
  template <typename Asked>
  HalfSpaceSolution solve(const Asked& asked, const HalfSpaceControl& control);
  void serve(SolveHalfSpace::Request& request, SolveHalfSpace::Response& response);
  bool run(const HalfSpaceGoal& goal, HalfSpaceResult& result);

  const HalfSpaceSolver solver_;
  SolutionPause& pause_;
  FindCase find_case_;
  Beside beside_;
  std::atomic<bool> stopping_{false};
  LongRun<HalfSpaceAction> action_;
  GuardedQueue queue_;
  ros::NodeHandle handle_;
  ros::ServiceServer service_;
  ros::AsyncSpinner spinner_;
};

}  // namespace mems_stiction
