#include "ros/transform_gate.hpp"

#include <utility>

#include "errors/error_text.hpp"
#include "ros/counter_surface_frame.hpp"

namespace mems_stiction {

TransformGate::TransformGate(ros::WallDuration timeout, Lookup lookup, std::size_t max_bytes)
    : timeout_(timeout), lookup_(std::move(lookup)), line_({0, max_bytes, true}) {}

void TransformGate::push(Waiting waiting, LineMember member, std::size_t bytes) {
  const ros::SteadyTime now = waiting.since;
  for (const Waiting& dropped : line_.push(std::move(waiting), member, bytes)) dropped.drop();
  poll(now);
}

void TransformGate::add(const std_msgs::Header& header, Accept accept, Reject reject, Drop drop,
                        std::size_t bytes, ros::SteadyTime now) {
  push({header, std::move(accept), std::move(reject), std::move(drop), now}, LineMember::kScan,
       bytes);
}

void TransformGate::addCounterSurface(std::function<void()> run, Drop drop, std::size_t bytes,
                                      ros::SteadyTime now) {
  push({std_msgs::Header(), [run = std::move(run)](const SurfacePose&) { run(); }, nullptr,
        std::move(drop), now},
       LineMember::kCounterSurface, bytes);
}

void TransformGate::poll(ros::SteadyTime now) {
  while (!line_.empty()) {
    const Waiting& first = line_.front();
    SurfacePose pose;
    std::string reason;
    try {
      if (first.reject) pose = lookup_(first.header);
    } catch (const NoTransform& error) {
      if (now - first.since < timeout_) return;
      reason = error.what();
    } catch (const std::exception& error) {  // whatever it is, the next in line must get its turn
      reason = reasonOf(error);
    }
    const Waiting done = line_.pop();
    if (reason.empty()) {
      done.accept(pose);
    } else {
      done.reject(reason);
    }
  }
}

}  // namespace mems_stiction
