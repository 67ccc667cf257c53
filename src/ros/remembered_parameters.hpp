#pragma once

/// @file
/// What the master's parameter server says of a node, remembered for a master that has lost it.

#include <string>
#include <utility>
#include <vector>

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include "ros/master_calls.hpp"

namespace mems_stiction {

/// The private namespace, and which plugins may publish the topics with heights, as they are when it is made. The node reads them at
/// its start alone, so they are what it goes by.
class RememberedParameters {
 public:
  RememberedParameters(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

  /// Whatever stands there goes. @return false: no answer from the master.
  bool putBack(const MasterCalls& calls) const;

 private:
  std::vector<std::pair<std::string, XmlRpc::XmlRpcValue>> parameters_;  ///< those that were set, full names
};

}  // namespace mems_stiction
