#pragma once

/// @file
/// Scans that wait for their transform, and counter-surfaces among them, in the order of arrival:
/// the first in line lets nobody pass. Nobody sleeps here; whoever owns the gate asks it now and
/// then. One object serves one thread.

#include <functional>
#include <string>

#include <ros/time.h>
#include <std_msgs/Header.h>

#include "ros/waiting_line.hpp"
#include "surface/alignment.hpp"

namespace mems_stiction {

/// Holds scans back, in order, until their transforms are there.
class TransformGate {
 public:
  /// @throw NoTransform while there is none; anything else if there will be none.
  using Lookup = std::function<SurfacePose(const std_msgs::Header&)>;
  using Accept = std::function<void(const SurfacePose&)>;
  using Reject = std::function<void(const std::string& reason)>;
  using Drop = std::function<void()>;

  /// - @p timeout how long a scan waits, from its arrival.
  /// - @p max_bytes that those who wait may take together; 0 = any number. Older ones are dropped
  /// (WaitingLine), but not the
  ///        first in line: transforms that come late would let nobody through.
  TransformGate(ros::WallDuration timeout, Lookup lookup, std::size_t max_bytes = 0);

  /// Exactly one of the three is called, here or by a later call.
  /// - @p bytes that the scan takes
  void add(const std_msgs::Header& header, Accept accept, Reject reject, Drop drop,
           std::size_t bytes, ros::SteadyTime now);

  /// It needs no transform, but must keep its place behind the scans.
  void addCounterSurface(std::function<void()> run, Drop drop, std::size_t bytes,
                         ros::SteadyTime now);

  /// Lets through, from the first in line on, what has its transform; rejects what has waited for
  /// too long.
  void poll(ros::SteadyTime now);

  std::size_t waiting() const { return line_.size(); }
  std::size_t waitingBytes() const { return line_.bytes(); }

 private:
  struct Waiting {
    std_msgs::Header header;
    Accept accept;
    Reject reject;  ///< empty for what needs no transform
    Drop drop;
    ros::SteadyTime since;
  };

  void push(Waiting waiting, LineMember member, std::size_t bytes);

  ros::WallDuration timeout_;
  Lookup lookup_;
  WaitingLine<Waiting> line_;
};

}  // namespace mems_stiction
