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
  tf2::Quaternion turn(transform.rotation.x, transform.rotation.y, transform.rotation.z,
                       transform.rotation.w);
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
    throw SurfaceError("the transform tilts the counter-surface by " + numberText(pose.tilt_x) +
                       ", " + numberText(pose.tilt_y) + " rad along x, y; must be in (-1.5, 1.5)");
  }
  return pose;
}

CounterSurfaceFrame::CounterSurfaceFrame(const ros::NodeHandle& handle, std::string frame)
    : frame_(std::move(frame)), transforms_(handle) {}

SurfacePose CounterSurfaceFrame::poseAt(const std_msgs::Header& header) const {
  if (header.frame_id.empty()) {
    throw SurfaceError(
        "the scan has no frame_id, so there is no transform to counter_surface/frame " + frame_);
  }
  // tf2 takes the stamp 0 for "the latest", which is not what was measured with the scan.
  if (header.stamp.isZero()) {
    throw SurfaceError("the scan has no stamp, so there is no transform to counter_surface/frame " +
                       frame_);
  }
  const std::string missing = "no transform from the scan's frame '" +
                              shortened(header.frame_id, kLongestQuotation) +
                              "' to counter_surface/frame " + frame_ + " at the scan's stamp";
  try {
    return poseOf(transforms_.at(header.frame_id, frame_, header.stamp));
  } catch (const NoTransform& error) {
    throw NoTransform(missing + ": " + error.what());
  } catch (const SurfaceError& error) {
    throw SurfaceError(missing + " " + error.what());
  }
}

}  // namespace mems_stiction
