#pragma once

/// @file
/// Scans that wait for their transform, in the order of arrival: the first in line lets nobody pass. Nobody sleeps
/// here; whoever owns the gate asks it now and then. One object serves one thread.

#include <deque>
#include <functional>
#include <string>

#include <ros/time.h>
#include <std_msgs/Header.h>

#include "mems_stiction/surface/alignment.hpp"

namespace mems_stiction {

/// Holds scans back, in order, until their transforms are there.
class TransformGate {
 public:
  /// @throw NoTransform while there is none, SurfaceError if there will be none.
  using Lookup = std::function<SurfacePose(const std_msgs::Header&)>;
  using Accept = std::function<void(const SurfacePose&)>;
  using Reject = std::function<void(const std::string& reason)>;

  /// - @p timeout how long a scan waits, from its arrival.
  TransformGate(ros::WallDuration timeout, Lookup lookup);

  /// Exactly one of both is called, here or by a later call.
  void add(const std_msgs::Header& header, Accept accept, Reject reject, ros::WallTime now);

  /// Something that needs no transform but must keep its place behind the scans.
  void addBehind(std::function<void()> run, ros::WallTime now);

  /// Lets through, from the first in line on, what has its transform; rejects what has waited for too long.
  void poll(ros::WallTime now);

  std::size_t waiting() const { return line_.size(); }

 private:
  struct Waiting {
    std_msgs::Header header;
    Accept accept;
    Reject reject;  ///< empty for what needs no transform
    ros::WallTime since;
  };

  ros::WallDuration timeout_;
  Lookup lookup_;
  std::deque<Waiting> line_;
};

}  // namespace mems_stiction
