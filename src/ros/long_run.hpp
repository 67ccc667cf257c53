#pragma once

/// @file
/// One action of the node: each goal runs on a thread of its own, so that live scans go on; a new
/// goal takes the place of the one that runs.
///
///     LongRun<SweepLoadAction> sweep(handle, "sweep_load", [&](const auto& goal, auto& result) {
///       return fill(result, goal, sweep.cancel());  // whether it came to its end
///     });
///     sweep.start();

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <thread>
#include <utility>

#include <actionlib/server/simple_action_server.h>
#include <ros/node_handle.h>

#include "errors/one_line.hpp"
#include "ros/goal_gate.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {

/// The server of one action, whose result has a `message`.
template <typename Action>
class LongRun {
 public:
  using Goal = typename Action::_action_goal_type::_goal_type;
  using Result = typename Action::_action_result_type::_result_type;
  using Feedback = typename Action::_action_feedback_type::_feedback_type;
  /// Fills the result and returns whether it came to its end; if not, and it leaves the message
  /// empty, it was cancelled. What it throws is the client's answer.
  using Work = std::function<bool(const Goal& goal, Result& result)>;

  /// - @p max_goal_size of a goal as it comes [bytes]
  LongRun(const ros::NodeHandle& private_handle, const std::string& name, double max_goal_size,
          Work work)
      : work_(std::move(work)),
        gate_(private_handle, name, max_goal_size),
        server_(
            GoalGate<Action>::inside(private_handle, name), name,
            [this](const auto& goal) { answer(*goal); }, kNoAutoStart) {
    server_.registerPreemptCallback([this] { cancel_ = true; });
  }
  ~LongRun() { stop(); }
  LongRun(const LongRun&) = delete;
  LongRun& operator=(const LongRun&) = delete;

  void start() {
    server_.start();
    gate_.open();
  }
  /// Asks what runs to end; it is then aborted.
  void stop() {
    stopping_ = true;
    cancel_ = true;
  }

  /// Whether the work is asked to end.
  const std::atomic<bool>& cancel() const { return cancel_; }
  void publishFeedback(const Feedback& feedback) { server_.publishFeedback(feedback); }

 private:
  static constexpr bool kNoAutoStart = false;
  /// From the arrival of a goal: rospy's SimpleActionClient never hears of an answer that comes
  /// before its send_goal has returned, and waits on (https://github.com/ros/actionlib/issues/206).
  /// Goals that are refused are answered that soon.
  static constexpr std::chrono::milliseconds kEarliestAnswer{100};

  void answer(const Goal& goal) {
    cancel_ = false;
    // Whoever asked to end before this goal's flag was cleared is asked again.
    if (stopping_ || server_.isPreemptRequested()) cancel_ = true;
    const auto earliest_answer = std::chrono::steady_clock::now() + kEarliestAnswer;
    Result result;
    bool is_complete = false;
    bool has_failed = false;
    try {
      is_complete = work_(goal, result);
      if (!is_complete && result.message.empty())
        result.message = stopping_ ? kShuttingDown : "cancelled";
    } catch (const std::future_error&) {
      result.message = kShuttingDown;
    } catch (const std::exception& error) {
      result.message = oneLine(error.what());
      has_failed = true;
    }
    if (!stopping_) std::this_thread::sleep_until(earliest_answer);
    if (is_complete) {
      server_.setSucceeded(result);
    } else if (!has_failed && server_.isPreemptRequested()) {
      server_.setPreempted(result, result.message);
    } else {
      server_.setAborted(result, result.message);
    }
  }

  Work work_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> cancel_{false};
  GoalGate<Action> gate_;
  actionlib::SimpleActionServer<Action> server_;  // last: its thread ends before the rest goes
};

}  // namespace mems_stiction
