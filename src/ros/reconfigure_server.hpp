#pragma once

/// @file
/// dynamic_reconfigure beside the services: shows what is set, passes changes to the one setter,
/// and puts back what it refuses.
///
/// Not by dynamic_reconfigure's own server: its requests are read by roscpp, which makes room for
/// all that a list states, and it reads and writes parameters within the calls that it serves.

#include <functional>
#include <mutex>
#include <string>

#include <dynamic_reconfigure/Config.h>
#include <ros/node_handle.h>
#include <boost/thread/recursive_mutex.hpp>

#include "configuration/running_settings.hpp"
#include "mems_stiction/StictionConfig.h"
#include "ros/master_calls.hpp"

namespace mems_stiction {

/// One per node; the thread of its queue calls back.
class ReconfigureServer {
 public:
  /// @throw OptionsError naming refused values; then nothing has changed.
  using Change = std::function<void(const RunningSettings&)>;

  /// Serves under the names of the private namespace; its parameters, a mirror that nobody reads,
  /// stand in `reconfigure` there, where they cannot be taken for settings.
  /// - @p settings outlive the server
  /// - @p max_message_size of a request [bytes]
  /// - @p changed the mirror is to be written
  ReconfigureServer(ros::NodeHandle& private_handle, const SettingsOwner& settings,
                    double max_message_size, Change change, std::function<void()> changed);

  /// Held from reading the settings to changing them, so that a change by a service and one by
  /// reconfigure do not undo each other.
  boost::recursive_mutex& mutex() { return mutex_; }

  /// After a change by somebody else, with the mutex held.
  void show();
  /// @return false: no answer from the master
  bool writeMirror(const MasterCalls& calls) const;

  /// What an earlier run of the node was set to last, and this one is not; empty once something is
  /// set. Waits for nobody, so that diagnostics may ask.
  std::string lost() const;

 private:
  void forgetLost();
  XmlRpc::XmlRpcValue mirror() const;
  dynamic_reconfigure::Config shown() const;
  void take(dynamic_reconfigure::Config& wanted);

  boost::recursive_mutex mutex_;
  const SettingsOwner& settings_;
  Change change_;
  std::function<void()> changed_;
  const std::string mirror_name_;
  mutable std::mutex lost_mutex_;  ///< held for a moment only, unlike the other
  std::string lost_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace mems_stiction
