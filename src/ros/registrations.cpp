#include "ros/registrations.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include <ros/connection_manager.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/service_manager.h>
#include <ros/xmlrpc_manager.h>

#include "ros/topic_names.hpp"

namespace mems_stiction {
namespace {

using XmlRpc::XmlRpcValue;

void append(XmlRpcValue& list, const std::string& text) {
  list[list.valid() ? list.size() : 0] = text;
}

XmlRpcValue listOf(std::initializer_list<std::string> texts) {
  XmlRpcValue list;
  for (const std::string& text : texts) append(list, text);
  return list;
}

std::string ownAddress() { return ros::XMLRPCManager::instance()->getServerURI(); }

/// Each process of roscpp offers this from its start to its end. (~get_loggers, too, but for a
/// moment: serveLoggers().)
std::string alwaysOffered() { return ros::this_node::getName() + "/set_logger_level"; }

/// What an array has.
std::vector<XmlRpcValue> elementsOf(XmlRpcValue& array) {
  std::vector<XmlRpcValue> elements;
  elements.reserve(static_cast<std::size_t>(array.size()));
  // NOLINTNEXTLINE(modernize-loop-convert): begin() of a value is that of a struct
  for (int i = 0; i < array.size(); ++i) elements.push_back(array[i]);
  return elements;
}

bool contains(XmlRpcValue& names, const std::string& name) {
  const std::vector<XmlRpcValue> elements = elementsOf(names);
  return std::any_of(elements.begin(), elements.end(), [&](XmlRpcValue element) {
    return static_cast<std::string>(element) == name;
  });
}

/// Addresses of those that this process gets messages of the topic from.
std::vector<std::string> connectedPublishers(const MasterCalls& calls, const std::string& topic) {
  std::vector<std::string> addresses;
  XmlRpcValue connections;
  if (!calls.askOurselves("getBusInfo", listOf({ros::this_node::getName()}), connections))
    return addresses;
  // Each [number, address of the other end, "i" for in, transport, topic, ...].
  for (XmlRpcValue& connection : elementsOf(connections)) {
    const std::string direction = connection[2];
    if (direction == "i" && static_cast<std::string>(connection[4]) == topic)
      addresses.push_back(connection[1]);
  }
  return addresses;
}

}  // namespace

Registrations::State Registrations::look(const MasterCalls& calls) {
  const std::string& name = ros::this_node::getName();
  XmlRpcValue address;
  if (!calls.hears("lookupNode", listOf({name, name}), address)) return State::kNoMaster;
  if (!address.valid()) return State::kForgotten;
  if (static_cast<std::string>(address) != ownAddress()) return State::kTaken;
  XmlRpcValue state;
  if (!calls.ask("getSystemState", listOf({name}), state)) return State::kNoMaster;
  // Publishers, subscribers, services: each a list of [name, [nodes]].
  std::set<std::string> services;
  for (XmlRpcValue& service : elementsOf(state[2])) {
    if (contains(service[1], name)) services.insert(static_cast<std::string>(service[0]));
  }
  if (services.count(alwaysOffered()) == 0) {
    // Between both answers another process may have taken the name, and with it all that the master
    // had of this one: to register again would end that process.
    if (!calls.hears("lookupNode", listOf({name, name}), address)) return State::kNoMaster;
    const bool is_taken = address.valid() && static_cast<std::string>(address) != ownAddress();
    return is_taken ? State::kTaken : State::kForgotten;
  }
  services_ = std::move(services);
  return State::kKnown;
}

bool Registrations::repeat(const MasterCalls& calls) const {
  return repeatPublications(calls) && repeatSubscriptions(calls) && repeatServices(calls);
}

bool Registrations::repeatPublications(const MasterCalls& calls) {
  const std::string& name = ros::this_node::getName();
  XmlRpcValue topics;
  if (!calls.askOurselves("getPublications", listOf({name}), topics)) return false;
  for (XmlRpcValue& topic : elementsOf(topics)) {
    XmlRpcValue subscribers;
    if (!calls.ask("registerPublisher", listOf({name, topic[0], topic[1], ownAddress()}),
                   subscribers))
      return false;
  }
  return true;
}

bool Registrations::repeatSubscriptions(const MasterCalls& calls) {
  const std::string& name = ros::this_node::getName();
  XmlRpcValue topics;
  if (!calls.askOurselves("getSubscriptions", listOf({name}), topics)) return false;
  for (XmlRpcValue& topic : elementsOf(topics)) {
    XmlRpcValue publishers;
    if (!calls.ask("registerSubscriber", listOf({name, topic[0], topic[1], ownAddress()}),
                   publishers))
      return false;
    // Publishers that are connected and have not registered anew stay: what is not in the list is
    // disconnected.
    for (const std::string& publisher : connectedPublishers(calls, topic[0])) {
      if (!contains(publishers, publisher)) append(publishers, publisher);
    }
    if (publishers.size() == 0) continue;
    XmlRpcValue update = listOf({name, topic[0]});
    update[2] = publishers;
    XmlRpcValue ignored;
    if (!calls.askOurselves("publisherUpdate", update, ignored)) return false;
  }
  return true;
}

bool Registrations::repeatServices(const MasterCalls& calls) const {
  const std::string& name = ros::this_node::getName();
  const std::string address = "rosrpc://" + ros::network::getHost() + ":" +
                              std::to_string(ros::ConnectionManager::instance()->getTCPPort());
  const std::string last = alwaysOffered();  // by it the process counts as known
  const auto isRegistered = [&](const std::string& service) {
    XmlRpcValue ignored;
    if (!ros::ServiceManager::instance()->lookupServicePublication(service))
      return true;  // no longer offered
    return calls.ask("registerService", listOf({name, service, address, ownAddress()}), ignored);
  };
  for (const std::string& service : services_) {
    if (service != last && !isRegistered(service)) return false;
  }
  return isRegistered(last);
}

RememberedParameters::RememberedParameters(const ros::NodeHandle& handle,
                                           const ros::NodeHandle& private_handle) {
  std::vector<std::string> names = {private_handle.getNamespace()};
  for (const char* topic : kImageTopics)
    names.push_back(handle.resolveName(topic) + "/disable_pub_plugins");
  for (const std::string& name : names) {
    XmlRpc::XmlRpcValue value;
    if (handle.getParam(name, value)) parameters_.emplace_back(name, value);
  }
}

bool RememberedParameters::putBack(const MasterCalls& calls) const {
  return std::all_of(parameters_.begin(), parameters_.end(), [&calls](const auto& parameter) {
    return calls.setParameter(parameter.first, parameter.second);
  });
}

}  // namespace mems_stiction
