#pragma once

/// @file
/// What /tf and /tf_static have said. In place of tf2_ros::TransformListener, which believes how
/// many transforms a message states.

#include <cstdint>
#include <stdexcept>
#include <string>

#include <geometry_msgs/Transform.h>
#include <ros/node_handle.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

namespace mems_stiction {

/// tf2 has no transform for that stamp; it may still come. what() says what tf2 has.
class NoTransform : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Listens on the handle's callback queue.
class TransformListener {
 public:
  explicit TransformListener(const ros::NodeHandle& handle);

  /// From a frame into another at a stamp, without waiting. May be called from every thread.
  /// @throw NoTransform if there is none yet. @throw SurfaceError if there can be none.
  geometry_msgs::Transform at(const std::string& target, const std::string& source,
                              const ros::Time& stamp) const;

 private:
  void take(const tf2_msgs::TFMessage& message, bool is_static);

  mutable tf2::BufferCore buffer_;
  ros::NodeHandle handle_;
  ros::Time last_update_;  ///< touched by the thread of the handle's queue only
  ros::Subscriber moving_;
  ros::Subscriber static_;
};

}  // namespace mems_stiction
