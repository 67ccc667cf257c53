#include "ros/diagnostics.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>

namespace mems_stiction {

Diagnostics::Diagnostics(const ros::NodeHandle& handle, const std::string& node)
    : prefix_(node.substr(1) + ": "),
      publisher_(
          ros::NodeHandle(handle).advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1)) {}

void Diagnostics::publish() const {
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ros::Time::now();
  for (const auto& [name, task] : tasks_) {
    diagnostic_updater::DiagnosticStatusWrapper status;
    task(status);
    status.name = prefix_ + name;
    status.hardware_id = "none";
    message.status.push_back(status);
  }
  publisher_.publish(message);
}

}  // namespace mems_stiction
