#include "ros/master_calls.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include <ros/master.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>

namespace mems_stiction {
namespace {

using XmlRpc::XmlRpcValue;
using Clock = std::chrono::steady_clock;

/// That a busy master may take for an answer.
constexpr std::chrono::seconds kCallPatience{5};
/// Between looks at whether to give up [s].
constexpr double kLook = 0.05;
/// Between looks at whether another process has ended.
constexpr std::chrono::milliseconds kUntilNextLook{20};

/// One call. execute() of the client waits for ever.
bool callOnce(const std::string& host, std::uint32_t port, const char* method,
              const XmlRpcValue& request, XmlRpcValue& response, const std::atomic<int>& give_up) {
  using XmlRpc::XmlRpcDispatch;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  if (!client.executeNonBlock(method, request)) return false;
  XmlRpcDispatch dispatch;
  dispatch.addSource(&client, XmlRpcDispatch::WritableEvent | XmlRpcDispatch::Exception);
  const Clock::time_point end = Clock::now() + kCallPatience;
  while (!client.executeCheckDone(response)) {
    if (give_up > 0 || Clock::now() > end || dispatch._sources.empty()) return false;
    dispatch.work(kLook);
  }
  return response.valid();
}

/// The payload of [code, status message, payload] if the code says success.
bool payloadOf(XmlRpcValue& response, XmlRpcValue& payload) {
  if (response.getType() != XmlRpcValue::TypeArray || response.size() != 3) return false;
  if (response[0].getType() != XmlRpcValue::TypeInt || static_cast<int>(response[0]) != 1)
    return false;
  payload = response[2];
  return true;
}

XmlRpcValue parameterRequest(const std::string& name, const XmlRpcValue& value) {
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  request[1] = name;
  request[2] = value;
  return request;
}

}  // namespace

bool MasterCalls::hears(const char* method, const XmlRpcValue& request,
                        XmlRpcValue& payload) const {
  payload.clear();
  XmlRpcValue response;
  if (ros::isShuttingDown() ||
      !callOnce(ros::master::getHost(), ros::master::getPort(), method, request, response, give_up))
    return false;
  payloadOf(response, payload);
  return true;
}

bool MasterCalls::ask(const char* method, const XmlRpcValue& request, XmlRpcValue& payload) const {
  return hears(method, request, payload) && payload.valid();
}

bool MasterCalls::askProcess(const std::string& address, const char* method,
                             const XmlRpcValue& request, XmlRpcValue& payload) const {
  std::string host;
  std::uint32_t port = 0;
  if (ros::isShuttingDown() || !ros::network::splitURI(address, host, port)) return false;
  XmlRpcValue response;
  return callOnce(host, port, method, request, response, give_up) && payloadOf(response, payload);
}

bool MasterCalls::askOurselves(const char* method, const XmlRpcValue& request,
                               XmlRpcValue& payload) const {
  return askProcess(ros::XMLRPCManager::instance()->getServerURI(), method, request, payload);
}

bool MasterCalls::setParameter(const std::string& name, const XmlRpcValue& value) const {
  XmlRpcValue ignored;
  return ask("setParam", parameterRequest(name, value), ignored);
}

std::string livingOwnerOf(const std::string& name) {
  const MasterCalls calls;
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  XmlRpcValue of_name = request;
  of_name[1] = name;
  XmlRpcValue address;
  XmlRpcValue process;
  if (!calls.ask("lookupNode", of_name, address) || address.getType() != XmlRpcValue::TypeString)
    return "";
  const std::string owner = address;
  return calls.askProcess(owner, "getPid", request, process) ? owner : "";
}

void endOwner(const std::string& owner) {
  const MasterCalls calls;
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  XmlRpcValue with_reason = request;
  with_reason[1] = "a node of the same name takes its place";
  XmlRpcValue ignored;
  calls.askProcess(owner, "shutdown", with_reason, ignored);
  const Clock::time_point end = Clock::now() + kCallPatience;
  while (Clock::now() < end && calls.askProcess(owner, "getPid", request, ignored))
    std::this_thread::sleep_for(kUntilNextLook);
}

void setParameterAtStart(const std::string& name, const XmlRpcValue& value) {
  XmlRpcValue response;
  XmlRpcValue ignored;
  ros::master::execute("setParam", parameterRequest(name, value), response, ignored, true);
}

}  // namespace mems_stiction
