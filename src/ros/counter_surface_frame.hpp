#pragma once

/// @file
/// Where does the counter-surface lie over a scan, by tf2?
///
/// The counter-surface's frame has its origin in the middle of its pixels, x along columns, y along
/// rows, and z as the scan's: a transform without rotation and translation mates the surfaces as
/// they are. The distance along z does not matter, since the surfaces are brought together until
/// they touch.

#include <string>

#include <geometry_msgs/Transform.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include "ros/transform_listener.hpp"
#include "surface/alignment.hpp"

namespace mems_stiction {

/// The counter-surface's frame in the scan's, as a pose: slopes of its plane, turn about its
/// normal, shift.
/// @throw SurfaceError if the plane is tilted beyond what a pose takes, or faces away from the
/// scan.
SurfacePose poseOf(const geometry_msgs::Transform& transform);

/// Looks up where the counter-surface lay at a scan's stamp.
class CounterSurfaceFrame {
 public:
  /// Listens to /tf and /tf_static on the handle's callback queue.
  CounterSurfaceFrame(const ros::NodeHandle& handle, std::string frame);

  /// At the header's stamp, without waiting. May be called from every thread.
  /// @throw NoTransform if there is none yet. @throw SurfaceError if there can be none: no
  /// frame_id, no stamp, a pose out of range.
  SurfacePose poseAt(const std_msgs::Header& header) const;

 private:
  std::string frame_;
  TransformListener transforms_;
};

}  // namespace mems_stiction
