#pragma once

/// @file
/// What clients send to an action, checked before the action server of actionlib gets it.
///
/// A cancel with a stamp asks for the end of all goals up to that time, and actionlib recalls each
/// later goal that is not younger; a goal of an older stamp than the last one's it cancels. After
/// one stamp of 2^32 - 1 s every goal ends so. Here a stamp that is yet to come becomes that of
/// now. Goals are read with their lengths checked (checked_messages.hpp); one that is refused is
/// rejected as actionlib would.

#include <algorithm>
#include <string>

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <std_msgs/Header.h>
#include <boost/make_shared.hpp>

#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "ros/checked_messages.hpp"
#include "ros/own_log.hpp"

namespace mems_stiction {

/// Between the topics `goal` and `cancel` of one action and its server, which gets them on
/// `goal_checked` and `cancel_checked`.
template <typename Action>
class GoalGate {
 public:
  /// - @p parent in whose namespace the action stands
  /// - @p max_bytes of a goal as it comes
  GoalGate(const ros::NodeHandle& parent, const std::string& name, double max_bytes)
      : name_(name),
        max_bytes_(max_bytes),
        handle_(parent, name),
        goals_(handle_.template advertise<Goal>("goal_checked", kQueue)),
        cancels_(handle_.template advertise<actionlib_msgs::GoalID>("cancel_checked", kQueue)),
        results_(handle_.template advertise<Result>("result", kQueue)) {}

  /// The handle that the server of the action is made with, in the parent's namespace.
  static ros::NodeHandle inside(const ros::NodeHandle& parent, const std::string& name) {
    return ros::NodeHandle(
        parent, "",
        {{name + "/goal", name + "/goal_checked"}, {name + "/cancel", name + "/cancel_checked"}});
  }

  /// From now on, as the server listens, goals and cancels pass.
  void open() {
    goal_subscriber_ = subscribeChecked<Goal>(
        handle_, "goal", kQueue,
        {[this](const auto& goal) { takeGoal(goal); },
         [this](const auto& bytes, const auto& reason) { refuseGoal(bytes, reason); }, max_bytes_});
    cancel_subscriber_ = subscribeChecked<actionlib_msgs::GoalID>(
        handle_, "cancel", kQueue,
        {[this](const auto& cancel) { takeCancel(cancel); },
         [this](const auto& /*bytes*/, const auto& reason) {
           warn("a cancel of " + name_ + " is passed over: " + reason);
         },
         max_bytes_});
  }

 private:
  using Goal = typename Action::_action_goal_type;
  using Result = typename Action::_action_result_type;
  static constexpr std::uint32_t kQueue = 50;
  /// A client's clock may go ahead of this one by so much without a word [s].
  static constexpr double kFastClock = 60.0;

  static void warn(const std::string& text) { logSoon(ros::console::levels::Warn, oneLine(text)); }

  /// The stamp that the server gets.
  ros::Time notAfterNow(const ros::Time& stamp, const char* what) const {
    const ros::Time now = ros::Time::now();
    if (stamp.toSec() > now.toSec() + kFastClock) {
      PlainStream text;
      text << "a " << what << " of " << name_ << " has a stamp that is yet to come, " << stamp
           << ": taken as one of now";
      warn(text.str());
    }
    return std::min(stamp, now);
  }

  void takeGoal(const boost::shared_ptr<const Goal>& goal) {
    const ros::Time stamp = notAfterNow(goal->goal_id.stamp, "goal");
    if (stamp == goal->goal_id.stamp) {
      goals_.publish(goal);
      return;
    }
    const auto taken = boost::make_shared<Goal>(*goal);
    taken->goal_id.stamp = stamp;
    goals_.publish(boost::shared_ptr<const Goal>(taken));
  }

  void refuseGoal(const BoundedStream& bytes, const std::string& reason) {
    std_msgs::Header header;
    Result answer;
    readBeginning(bytes, header, answer.status.goal_id);
    warn("a goal of " + name_ + " is rejected: " + reason);
    answer.header.stamp = ros::Time::now();
    answer.status.status = actionlib_msgs::GoalStatus::REJECTED;
    answer.status.text = answer.result.message = oneLine(reason);
    results_.publish(answer);
  }

  void takeCancel(const actionlib_msgs::GoalID::ConstPtr& cancel) {
    const auto taken = boost::make_shared<actionlib_msgs::GoalID>(*cancel);
    taken->stamp = notAfterNow(cancel->stamp, "cancel");
    cancels_.publish(boost::shared_ptr<const actionlib_msgs::GoalID>(taken));
  }

  std::string name_;
  double max_bytes_;
  ros::NodeHandle handle_;
  ros::Publisher goals_;
  ros::Publisher cancels_;
  ros::Publisher results_;  ///< beside those of the server
  ros::Subscriber goal_subscriber_;
  ros::Subscriber cancel_subscriber_;
};

}  // namespace mems_stiction
