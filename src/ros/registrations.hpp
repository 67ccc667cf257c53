#pragma once

/// @file
/// What this process has registered at the ROS master: is it still known there, and if not, all of
/// it once more.
///
/// A master keeps what was registered in memory alone, and roscpp registers once. After a restart
/// of the master, connections that were made before go on, but nobody finds the node any more. Here
/// everything that the process still offers is registered anew under its old addresses, so that no
/// connection, no scan that waits and no setting is lost on the way. What its parameter server said
/// of a node is remembered and put back.

#include <set>
#include <string>
#include <utility>
#include <vector>

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include "ros/master_calls.hpp"

namespace mems_stiction {

/// One per process; for one thread.
class Registrations {
 public:
  enum class State {
    kKnown,      ///< the master knows this process
    kForgotten,  ///< the master answers and does not know it: another one at the same address
    kTaken,      ///< another process has this one's name there
    kNoMaster,   ///< no answer
  };

  /// Asks the master. While the process is known, also notes which services it has there, since
  /// roscpp has no list of them.
  State look(const MasterCalls& calls);

  /// Registers every topic of the process, and every service that was noted and is still offered.
  /// @return false: the master was gone before the end, or ROS is shutting down; to be called
  /// again.
  bool repeat(const MasterCalls& calls) const;

 private:
  static bool repeatPublications(const MasterCalls& calls);
  static bool repeatSubscriptions(const MasterCalls& calls);
  bool repeatServices(const MasterCalls& calls) const;

  std::set<std::string> services_;  ///< names, as noted
};

/// The private namespace, and which plugins may publish the topics with heights, as they are when
/// it is made. The node reads them at its start alone, so they are what it goes by.
class RememberedParameters {
 public:
  RememberedParameters(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

  /// Whatever stands there goes. @return false: no answer from the master.
  bool putBack(const MasterCalls& calls) const;

 private:
  std::vector<std::pair<std::string, XmlRpc::XmlRpcValue>>
      parameters_;  ///< those that were set, full names
};

}  // namespace mems_stiction
