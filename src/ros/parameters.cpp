#include "mems_stiction/ros/parameters.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_yaml.hpp"
#include "mems_stiction/ros/topic_names.hpp"

namespace mems_stiction {
namespace {

YAML::Node yamlOf(XmlRpc::XmlRpcValue& value, const std::string& key, std::vector<std::string>& violations) {
  using XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value) ? "true" : "false");
    case XmlRpcValue::TypeInt:
      return YAML::Node(std::to_string(static_cast<int>(value)));
    case XmlRpcValue::TypeDouble:
      return YAML::Node(yamlNumber(static_cast<double>(value)));
    case XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case XmlRpcValue::TypeArray: {
      YAML::Node list(YAML::NodeType::Sequence);
      const int size = value.size();  // begin() and end() are those of a struct
      for (int i = 0; i < size; ++i) list.push_back(yamlOf(value[i], key, violations));
      return list;
    }
    case XmlRpcValue::TypeStruct: {
      YAML::Node map(YAML::NodeType::Map);
      for (auto& entry : value) {
        map[entry.first] = yamlOf(entry.second, key.empty() ? entry.first : key + "/" + entry.first, violations);
      }
      return map;
    }
    default:
      violations.push_back(key +
                           ": dates, binary data and empty values are not allowed, must be a number, true or "
                           "false, or a text");
      return YAML::Node();
  }
}

/// image_transport reads parameters of its own beside ours: `image_transport` names the transport of our subscriptions;
/// publishers in the private namespace keep their plugins' settings under the name of the topic.
bool belongsToImageTransport(const std::string& key, const YAML::Node& value) {
  static constexpr std::array<const char*, 6> kImageTopics = {kHeightTopic,         kCounterHeightTopic,
                                                              kDeformedHeightTopic, kDeformedCounterHeightTopic,
                                                              kContactMapTopic,     kHalfSpaceContactMapTopic};
  static constexpr std::array<const char*, 5> kPluginKeys = {"disable_pub_plugins", "image_transport", "compressed",
                                                             "compressedDepth", "theora"};
  if (key == "image_transport") return true;
  if (std::find(kImageTopics.begin(), kImageTopics.end(), key) == kImageTopics.end() || !value.IsMap()) return false;
  return std::all_of(value.begin(), value.end(), [](const auto& entry) {
    return std::find(kPluginKeys.begin(), kPluginKeys.end(), entry.first.Scalar()) != kPluginKeys.end();
  });
}

}  // namespace

void DisplayOptions::describe(OptionVisitor& visitor) {
  visitor.text("display/frame", frame, "frame_id of the views for rviz; empty = the scan's");
  visitor.number("display/scale", scale, "m on the screen per m", Range::nonNegative(),
                 "enlargement of the views for rviz; 0 = the longer side fills 10 m");
  visitor.number("display/height_exaggeration", height_exaggeration, "", Range::nonNegative(),
                 "enlargement of heights against lengths; 0 = chosen for each scan");
  visitor.integer("display/max_points", max_points, Range::within(1, 1e8), "points of surface_points");
  visitor.integer("display/max_markers", max_markers, Range::within(1, 1e6), "discs of asperity_markers");
  visitor.number("display/min_marker_diameter", min_marker_diameter, "m on the screen", Range::nonNegative(),
                 "smaller contacts get discs of this size, so that they are seen");
  visitor.integer("display/max_preview_size", max_preview_size, Range::within(1, 32768),
                  "pixels of the longer side of preview");
}

void TransformOptions::describe(OptionVisitor& visitor) {
  visitor.text("counter_surface/frame", frame, "tf frame of the counter-surface; empty = counter_surface/pose serves");
  visitor.number("counter_surface/transform_timeout", timeout, "s", Range::nonNegative(),
                 "how long a scan waits for the transform at its stamp");
}

void NodeOptions::describe(OptionVisitor& visitor) {
  visitor.integer("queue_size", queue_size, Range::within(1, 1000000),
                  "scans that may wait; with drop_policy all more wait and the diagnostics say so");
  visitor.enumeration<DropPolicy>("drop_policy", drop_policy,
                                  {{"all", DropPolicy::kAll}, {"latest", DropPolicy::kLatest}},
                                  "all: every scan is predicted; latest: older scans are dropped and counted");
  visitor.flag("use_scan_info", use_scan_info, "false: the parameters scan/... serve for every scan");
  visitor.number("pairing_timeout", pairing_timeout, "s", Range::positive(),
                 "how long a scan and its scan_info wait for each other");
  visitor.flag("accumulate_deformation", accumulate_deformation,
               "each contact leaves its mark on the scans of the same size that follow");
  visitor.number("diagnostic_period", diagnostic_period, "s", Range::positive(), "between messages on /diagnostics");
  visitor.number("warning_period", warning_period, "s", Range::nonNegative(),
                 "at most one warning about scans in so long a time");
  transform.describe(visitor);
  display.describe(visitor);
}

void NodeConfiguration::describe(OptionVisitor& visitor) {
  core.describe(visitor);
  node.describe(visitor);
}

YAML::Node yamlFromParameters(XmlRpc::XmlRpcValue tree) {
  std::vector<std::string> violations;
  const YAML::Node node = yamlOf(tree, "", violations);
  if (!violations.empty()) throw OptionsError(std::move(violations));
  return node;
}

NodeConfiguration nodeConfigurationFromYaml(const YAML::Node& tree) {
  YAML::Node ours(YAML::NodeType::Map);
  for (const auto& entry : tree) {
    const std::string key = entry.first.Scalar();
    if (key != kReconfigureParameters && !belongsToImageTransport(key, entry.second)) ours[key] = entry.second;
  }
  NodeConfiguration configuration;
  std::vector<std::string> violations =
      readYaml(ours, [&configuration](OptionVisitor& visitor) { configuration.describe(visitor); });
  // Combinations of settings; ranges are found by both and named once.
  for (const std::string& line : configuration.core.validate()) {
    if (std::find(violations.begin(), violations.end(), line) == violations.end()) violations.push_back(line);
  }
  if (!configuration.node.transform.frame.empty() && !isIdentity(configuration.core.counter_surface.pose)) {
    violations.push_back("counter_surface/frame: " + configuration.node.transform.frame +
                         " is not allowed with a counter_surface/pose other than 0; must be empty, or the pose 0");
  }
  if (!violations.empty()) throw OptionsError(std::move(violations));
  return configuration;
}

NodeConfiguration readParameters(const ros::NodeHandle& private_handle) {
  XmlRpc::XmlRpcValue tree;
  if (!private_handle.getParam(private_handle.getNamespace(), tree)) return {};
  if (tree.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    throw OptionsError({private_handle.getNamespace() + ": a single value is not allowed, must be a map of settings"});
  }
  return nodeConfigurationFromYaml(yamlFromParameters(tree));
}

}  // namespace mems_stiction
