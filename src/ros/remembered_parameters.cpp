#include "ros/remembered_parameters.hpp"

#include <algorithm>

#include "ros/topic_names.hpp"

namespace mems_stiction {

RememberedParameters::RememberedParameters(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  std::vector<std::string> names = {private_handle.getNamespace()};
  for (const char* topic : kImageTopics) names.push_back(handle.resolveName(topic) + "/disable_pub_plugins");
  for (const std::string& name : names) {
    XmlRpc::XmlRpcValue value;
    if (handle.getParam(name, value)) parameters_.emplace_back(name, value);
  }
}

bool RememberedParameters::putBack(const MasterCalls& calls) const {
  return std::all_of(parameters_.begin(), parameters_.end(),
                     [&calls](const auto& parameter) { return calls.setParameter(parameter.first, parameter.second); });
}

}  // namespace mems_stiction
