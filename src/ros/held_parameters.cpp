#include "mems_stiction/ros/held_parameters.hpp"

#include <algorithm>

#include <ros/master.h>
#include <ros/this_node.h>

#include "mems_stiction/ros/topic_names.hpp"

namespace mems_stiction {

HeldParameters::HeldParameters(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  std::vector<std::string> names = {private_handle.getNamespace()};
  for (const char* topic : kImageTopics) names.push_back(handle.resolveName(topic) + "/disable_pub_plugins");
  for (const std::string& name : names) {
    XmlRpc::XmlRpcValue value;
    if (handle.getParam(name, value)) parameters_.emplace_back(name, value);
  }
}

bool HeldParameters::putBack() const {
  return std::all_of(parameters_.begin(), parameters_.end(), [](const auto& parameter) {
    XmlRpc::XmlRpcValue request;
    request[0] = ros::this_node::getName();
    request[1] = parameter.first;
    request[2] = parameter.second;
    XmlRpc::XmlRpcValue response;
    XmlRpc::XmlRpcValue ignored;
    return ros::master::execute("setParam", request, response, ignored, false);
  });
}

}  // namespace mems_stiction
