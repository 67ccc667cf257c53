#pragma once

/// @file
/// dynamic_reconfigure beside the services: shows what is set, passes changes to the one setter, and puts back what it
/// refuses.

#include <functional>
#include <memory>

#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>
#include <boost/thread/recursive_mutex.hpp>

#include "mems_stiction/StictionConfig.h"
#include "mems_stiction/ros/running_options.hpp"

namespace mems_stiction {

/// One per node; the thread of its queue calls back.
class ReconfigureServer {
 public:
  /// @throw OptionsError naming refused values; then nothing has changed.
  using Change = std::function<void(const RunningOptions&)>;

  /// Serves under the names of the private namespace; its parameters, a mirror that nobody reads, stand in
  /// `reconfigure` there, where they cannot be taken for settings.
  ReconfigureServer(const ros::NodeHandle& private_handle, const RunningOptions& options, Change change);

  /// Held while settings change, so that a change by a service and one by reconfigure do not undo each other.
  boost::recursive_mutex& mutex() { return mutex_; }

  /// As they are; with the mutex held.
  const RunningOptions& options() const { return options_; }

  /// After a change by somebody else, with the mutex held.
  void show(const RunningOptions& options);

 private:
  void take(StictionConfig& config);

  boost::recursive_mutex mutex_;
  RunningOptions options_;  ///< as they are
  Change change_;
  std::unique_ptr<dynamic_reconfigure::Server<StictionConfig>> server_;
};

}  // namespace mems_stiction
