#pragma once

/// @file
/// What the node says of itself on /diagnostics. diagnostic_updater's own updater asks for a
/// parameter before each message.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>

namespace mems_stiction {

/// For one thread.
class Diagnostics {
 public:
  using Task = std::function<void(diagnostic_updater::DiagnosticStatusWrapper&)>;

  /// - @p node the full name
  Diagnostics(const ros::NodeHandle& handle, const std::string& node);

  void add(const std::string& name, Task task) { tasks_.emplace_back(name, std::move(task)); }
  /// One message with the status of each task.
  void publish() const;

 private:
  std::string prefix_;
  ros::Publisher publisher_;
  std::vector<std::pair<std::string, Task>> tasks_;
};

}  // namespace mems_stiction
