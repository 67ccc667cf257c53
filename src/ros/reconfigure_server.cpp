#include "mems_stiction/ros/reconfigure_server.hpp"

#include <future>
#include <string>
#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/ros/reconfigure_conversion.hpp"
#include "mems_stiction/ros/topic_names.hpp"

namespace mems_stiction {
namespace {

ros::NodeHandle reconfigureHandle(const ros::NodeHandle& private_handle) {
  // What an earlier run left would be taken for the settings of this one.
  private_handle.deleteParam(kReconfigureParameters);
  ros::M_string remappings;
  for (const char* name : {"set_parameters", "parameter_descriptions", "parameter_updates"}) {
    remappings[name] = private_handle.resolveName(name);
  }
  return ros::NodeHandle(private_handle, kReconfigureParameters, remappings);
}

StictionConfig configOf(const RunningSettings& settings) {
  StictionConfig config = StictionConfig::__getDefault__();
  dynamic_reconfigure::Config message = reconfigureMessage(settings);
  config.__fromMessage__(message);
  return config;
}

}  // namespace

ReconfigureServer::ReconfigureServer(const ros::NodeHandle& private_handle, const SettingsOwner& settings,
                                     Change change)
    : settings_(settings),
      change_(std::move(change)),
      server_(
          std::make_unique<dynamic_reconfigure::Server<StictionConfig>>(mutex_, reconfigureHandle(private_handle))) {
  server_->updateConfig(configOf(settings.current()));
  bool is_first = true;  // setCallback() calls at once, with what is set
  server_->setCallback([this, is_first](StictionConfig& config, std::uint32_t) mutable {
    if (!std::exchange(is_first, false)) take(config);
  });
}

void ReconfigureServer::show() { server_->updateConfig(configOf(settings_.current())); }

void ReconfigureServer::take(StictionConfig& config) {
  try {
    dynamic_reconfigure::Config message;
    config.__toMessage__(message);
    RunningSettings changed = settings_.current();
    applyReconfigure(message, changed);
    change_(changed);
  } catch (const OptionsError& error) {
    for (const std::string& line : error.violations())
      ROS_WARN_STREAM("reconfigure refused, nothing changed: " << line);
    config = configOf(settings_.current());
  } catch (const std::future_error&) {
    config = configOf(settings_.current());  // the node is shutting down
  }
}

}  // namespace mems_stiction
