#include "mems_stiction/ros/transform_gate.hpp"

#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/ros/counter_surface_frame.hpp"

namespace mems_stiction {

TransformGate::TransformGate(ros::WallDuration timeout, Lookup lookup)
    : timeout_(timeout), lookup_(std::move(lookup)) {}

void TransformGate::add(const std_msgs::Header& header, Accept accept, Reject reject, ros::WallTime now) {
  line_.push_back({header, std::move(accept), std::move(reject), now});
  poll(now);
}

void TransformGate::addBehind(std::function<void()> run, ros::WallTime now) {
  line_.push_back({std_msgs::Header(), [run = std::move(run)](const SurfacePose&) { run(); }, nullptr, now});
  poll(now);
}

void TransformGate::poll(ros::WallTime now) {
  while (!line_.empty()) {
    const Waiting& first = line_.front();
    SurfacePose pose;
    std::string reason;
    try {
      if (first.reject) pose = lookup_(first.header);
    } catch (const NoTransform& error) {
      if (now - first.since < timeout_) return;
      reason = error.what();
    } catch (const SurfaceError& error) {
      reason = error.what();
    }
    const Waiting done = std::move(line_.front());
    line_.pop_front();
    if (reason.empty()) {
      done.accept(pose);
    } else {
      done.reject(reason);
    }
  }
}

}  // namespace mems_stiction
