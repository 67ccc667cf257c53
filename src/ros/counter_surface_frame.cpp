#include "ros/counter_surface_frame.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2/exceptions.h>

#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "ros/checked_messages.hpp"
#include "ros/own_log.hpp"

namespace mems_stiction {
namespace {

constexpr double kLargestTilt = 1.5;  // [rad], the limit of SurfacePose

}  // namespace

SurfacePose poseOf(const geometry_msgs::Transform& transform) {
  tf2::Quaternion turn(transform.rotation.x, transform.rotation.y, transform.rotation.z, transform.rotation.w);
  turn.normalize();
  const tf2::Vector3 normal = tf2::Matrix3x3(turn).getColumn(2);

  SurfacePose pose;
  pose.offset_x = transform.translation.x;
  pose.offset_y = transform.translation.y;
  // turn = tilt x twist about the counter-surface's own normal.
  pose.rotation = std::remainder(2.0 * std::atan2(turn.z(), turn.w()), 2.0 * kPi);
  // The plane's slopes; atan2 gives more than a right angle for one that faces away.
  // None is 0, not -0, which would be written otherwise and be other settings.
  pose.tilt_x = 0.0 - std::atan2(normal.x(), normal.z());
  pose.tilt_y = 0.0 - std::atan2(normal.y(), normal.z());
  if (!(std::abs(pose.tilt_x) < kLargestTilt && std::abs(pose.tilt_y) < kLargestTilt)) {
    throw SurfaceError("the transform tilts the counter-surface by " + numberText(pose.tilt_x) + ", " +
                       numberText(pose.tilt_y) + " rad along x, y; must be in (-1.5, 1.5)");
  }
  return pose;
}

CounterSurfaceFrame::CounterSurfaceFrame(const ros::NodeHandle& handle, std::string frame)
    : frame_(std::move(frame)), handle_(handle) {
  // In place of tf2_ros::TransformListener, which believes how many transforms a message states.
  constexpr std::uint32_t kQueue = 100;
  const auto subscribe = [&](const std::string& topic, bool is_static) {
    return subscribeChecked<tf2_msgs::TFMessage>(handle_, topic, kQueue,
                                                 {[this, is_static](const auto& message) { take(*message, is_static); },
                                                  [topic](const auto&, const std::string& reason) {
                                                    logSoon(ros::console::levels::Warn,
                                                            "a message of " + topic + " is passed over: " + reason);
                                                  }});
  };
  moving_ = subscribe("/tf", false);
  static_ = subscribe("/tf_static", true);
}

/// As tf2_ros::TransformListener does, but one transform that tf2 cannot take leaves the others of the message.
void CounterSurfaceFrame::take(const tf2_msgs::TFMessage& message, bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_update_) {
    logSoon(ros::console::levels::Warn, "the clock has jumped back: transforms from before are forgotten");
    buffer_.clear();
  }
  last_update_ = now;
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    try {
      buffer_.setTransform(transform, "a publisher of tf", is_static);
    } catch (const std::exception& error) {
      logSoon(ros::console::levels::Warn,
              oneLine("a transform to '" + shortened(transform.child_frame_id, kLongestQuotation) +
                      "' is passed over: " + error.what()));
    }
  }
}

SurfacePose CounterSurfaceFrame::poseAt(const std_msgs::Header& header) const {
  if (header.frame_id.empty()) {
    throw SurfaceError("the scan has no frame_id, so there is no transform to counter_surface/frame " + frame_);
  }
  // tf2 takes the stamp 0 for "the latest", which is not what was measured with the scan.
  if (header.stamp.isZero()) {
    throw SurfaceError("the scan has no stamp, so there is no transform to counter_surface/frame " + frame_);
  }
  const std::string missing = "no transform from the scan's frame '" + shortened(header.frame_id, kLongestQuotation) +
                              "' to counter_surface/frame " + frame_ + " at the scan's stamp";
  geometry_msgs::TransformStamped found;
  try {
    found = buffer_.lookupTransform(header.frame_id, frame_, header.stamp);
  } catch (const tf2::TransformException& error) {
    throw NoTransform(missing + ": " + error.what());
  } catch (const std::runtime_error& error) {
    // ros::Time refuses differences beyond 2^31 s and sums beyond 2^32 s.
    PlainStream stamp;
    stamp << header.stamp;
    throw SurfaceError(missing + " " + stamp.str() +
                       " s, which lies too far from those of the transforms: " + error.what());
  }
  return poseOf(found.transform);
}

}  // namespace mems_stiction
