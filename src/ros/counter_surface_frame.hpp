#pragma once

/// @file
/// Where does the counter-surface lie over a scan, by tf2?
///
/// The counter-surface's frame has its origin in the middle of its pixels, x along columns, y along rows, and z as the
/// scan's: a transform without rotation and translation mates the surfaces as they are. The distance along z does not
/// matter, since the surfaces are brought together until they touch.

#include <memory>
#include <stdexcept>
#include <string>

#include <geometry_msgs/Transform.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include "surface/alignment.hpp"

namespace mems_stiction {

/// tf2 has no transform for that stamp; it may still come. what() says what tf2 has.
class NoTransform : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The counter-surface's frame in the scan's, as a pose: slopes of its plane, turn about its normal, shift.
/// @throw SurfaceError if the plane is tilted beyond what a pose takes, or faces away from the scan.
SurfacePose poseOf(const geometry_msgs::Transform& transform);

/// Looks up where the counter-surface lay at a scan's stamp.
class CounterSurfaceFrame {
 public:
  /// Listens to /tf and /tf_static on the handle's callback queue.
  CounterSurfaceFrame(const ros::NodeHandle& handle, std::string frame);

  /// At the header's stamp, without waiting. May be called from every thread.
  /// @throw NoTransform if there is none yet. @throw SurfaceError if there can be none: no frame_id, no stamp, a pose
  /// out of range.
  SurfacePose poseAt(const std_msgs::Header& header) const;

 private:
  void take(const tf2_msgs::TFMessage& message, bool is_static);

  std::string frame_;
  mutable tf2::BufferCore buffer_;
  ros::NodeHandle handle_;
  ros::Time last_update_;  ///< touched by the thread of the handle's queue only
  ros::Subscriber moving_;
  ros::Subscriber static_;
};

}  // namespace mems_stiction
