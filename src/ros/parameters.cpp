#include "ros/parameters.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <ros/console.h>
#include <yaml-cpp/yaml.h>

#include "configuration/named_files.hpp"
#include "errors/one_line.hpp"
#include "files/input_file.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "ros/checked_messages.hpp"
#include "ros/master_calls.hpp"
#include "ros/scan_folders.hpp"
#include "ros/topic_names.hpp"
#include "settings/option_values.hpp"
#include "settings/option_yaml.hpp"
#include "settings/yaml_text.hpp"
#include "surface/counter_surface.hpp"

namespace mems_stiction {
namespace {

/// Durations of ROS end at 2^31 s.
constexpr double kLongestDuration = 1e9;
/// Timers go by them: shorter ones would keep a core busy with nothing else.
const Range kPeriod = Range::within(0.01, kLongestDuration);

/// roscpp keeps the quotes of _part/serial:="'0012'", without which it takes a number for one.
std::string withoutQuotes(const std::string& text) {
  const bool is_quoted = text.size() >= 2 && text.front() == text.back() &&
                         (text.front() == '\'' || text.front() == '"');
  return is_quoted && text.find(text.front(), 1) == text.size() - 1
             ? text.substr(1, text.size() - 2)
             : text;
}

YAML::Node yamlOf(XmlRpc::XmlRpcValue& value, const std::string& key,
                  std::vector<std::string>& violations) {
  using XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return typedNode(static_cast<bool>(value) ? "true" : "false", "bool");
    case XmlRpcValue::TypeInt:
      return typedNode(std::to_string(static_cast<int>(value)), "int");
    case XmlRpcValue::TypeDouble:
      return typedNode(yamlNumber(static_cast<double>(value)), "float");
    case XmlRpcValue::TypeString:
      return YAML::Node(withoutQuotes(static_cast<std::string>(value)));
    case XmlRpcValue::TypeArray: {
      YAML::Node list(YAML::NodeType::Sequence);
      const int size = value.size();  // begin() and end() are those of a struct
      for (int i = 0; i < size; ++i) list.push_back(yamlOf(value[i], key, violations));
      return list;
    }
    case XmlRpcValue::TypeStruct: {
      YAML::Node map(YAML::NodeType::Map);
      for (auto& entry : value) {
        // operator[] looks at all keys before: 10,000 of them took 12 s
        map.force_insert(
            entry.first,
            yamlOf(entry.second, key.empty() ? entry.first : key + "/" + entry.first, violations));
      }
      return map;
    }
    default:
      violations.push_back(
          shortened(key, kLongestQuotation) +
          ": dates, binary data and empty values are not allowed, must be a number, true or "
          "false, or a text");
      return YAML::Node();
  }
}

/// Names the transport of a node's subscriptions to images.
constexpr const char* kTransport = "image_transport";

/// Heights come raw. What other transports' plugins receive is theirs: they allocate what a message
/// states.
void requireRawTransport(const YAML::Node& value, std::vector<std::string>& violations) {
  if (value.IsScalar() && value.Scalar() == "raw") return;
  const std::string stated =
      value.IsScalar() ? "'" + shortened(value.Scalar(), kLongestQuotation) + "'" : "a list or map";
  violations.push_back(std::string(kTransport) + ": " + stated +
                       " is not allowed, must be raw: other transports decode before the size of a "
                       "message is checked. "
                       "`rosrun image_transport republish` decodes beside the node");
}

/// image_transport reads parameters of its own beside ours: `image_transport` names the transport
/// of subscriptions; publishers in the private namespace keep their plugins' settings under the
/// name of the topic.
bool belongsToImageTransport(const std::string& key, const YAML::Node& value) {
  static constexpr std::array<const char*, 5> kPluginKeys = {
      "disable_pub_plugins", "image_transport", "compressed", "compressedDepth", "theora"};
  if (key == kTransport) return true;
  if (std::find(kImageTopics.begin(), kImageTopics.end(), key) == kImageTopics.end() ||
      !value.IsMap())
    return false;
  return std::all_of(value.begin(), value.end(), [](const auto& entry) {
    return std::find(kPluginKeys.begin(), kPluginKeys.end(), entry.first.Scalar()) !=
           kPluginKeys.end();
  });
}

/// Where launch files put the texts of configuration files, and the names of these files.
constexpr const char* kFileTexts[] = {"node_config", "config"};

/// Where the node writes down what it took, when no file says what that should be.
constexpr const char* kTakenParameters = "taken_at_start";

/// Of the name of such a file [bytes]: every sentence about its text begins with it.
constexpr std::size_t kLongestPath = 4096;

/// One of them.
struct FileText {
  std::string name;
  YAML::Node tree;

  FileText(const std::string& section, const YAML::Node& parameters,
           std::vector<std::string>& violations)
      : name(section + "/text") {
    if (!parameters.IsMap()) {
      violations.push_back(section + ": must have the keys file and text of a configuration file");
      return;
    }
    std::string text;
    for (const auto& entry : parameters) {
      const std::string key = entry.first.Scalar();
      if ((key != "file" && key != "text") || !entry.second.IsScalar()) {
        violations.push_back(section + "/" + shortened(key, kLongestQuotation) +
                             " is given, but there is no such setting");
      } else {
        (key == "file" ? name : text) = entry.second.Scalar();
      }
    }
    if (name.size() > kLongestPath) {
      violations.push_back(section + "/file: a text of " + std::to_string(name.size()) +
                           " bytes is not allowed, must have at most " +
                           std::to_string(kLongestPath));
      name = section + "/text";
      return;
    }
    if (text.size() > kSettingsInput.max_bytes) {
      violations.push_back(name + ": has " + std::to_string(text.size()) +
                           " bytes, more than the " + std::to_string(kSettingsInput.max_bytes) +
                           " of " + kSettingsInput.name);
      return;
    }
    try {
      tree = parseYaml(text, name);
    } catch (const FileError& error) {
      violations.emplace_back(error.what());
    }
  }
};

/// Relative paths that a file states go by its folder. Where nobody says which that is, they would
/// go by the node's.
void placeFilesOf(const FileText& file, const std::vector<std::string>& keys,
                  Configuration& configuration, std::vector<std::string>& violations) {
  const std::filesystem::path name = file.name;
  if (name.is_absolute()) {
    placeNamedFiles(keys, name.parent_path(), configuration);
    return;
  }
  for (const auto& [key, path] : filesNamedBy(configuration)) {
    if (std::filesystem::path(path).is_absolute() ||
        std::find(keys.begin(), keys.end(), key) == keys.end())
      continue;
    violations.push_back(file.name + ": " + key + ": '" + path +
                         "' goes by the folder of this file, which nobody states; give the whole "
                         "path of either, as by "
                         "config:=$PWD/part.yaml");
  }
}

/// Every key of a tree with its value as text.
std::map<std::string, std::string> valuesIn(const YAML::Node& tree) {
  std::map<std::string, std::string> values;
  for (const auto& [key, value] : statedIn(tree))
    values[key] = value.IsScalar() ? value.Scalar() : YAML::Dump(value);
  return values;
}

/// One line for each parameter that an earlier run has taken and that nobody has set since, while
/// others were set: nothing tells whether it belongs to them. rosparam and launch files add to what
/// lies there.
std::vector<std::string> leftOvers(const YAML::Node& ours, const std::string& taken) {
  const std::map<std::string, std::string> now = valuesIn(ours);
  std::map<std::string, std::string> before;
  try {
    before = valuesIn(parseYaml(taken, kTakenParameters));
  } catch (const FileError& error) {
    return {std::string(error.what()) + "; the node writes this parameter itself: delete it"};
  }
  if (before.empty() || now == before) return {};
  std::vector<std::string> lines;
  for (const auto& [key, value] : now) {
    const auto old = before.find(key);
    if (old == before.end() || old->second != value) continue;
    lines.push_back(
        shortened(key, kLongestQuotation) + ": " + shortened(value, kLongestQuotation) +
        " lies there since an earlier run, and others were set since: does it still hold?" +
        " Clear the node's parameters (rosparam delete, or clear_params=\"true\" in the launch "
        "file) before" +
        " loading new ones, or set it anew to the same value after clearing");
  }
  return lines.size() == now.size() ? std::vector<std::string>() : lines;
}

}  // namespace

void DisplayOptions::describe(OptionVisitor& visitor) {
  visitor.text("display/frame", frame, "frame_id of the views for rviz; empty = the scan's");
  visitor.number("display/scale", scale, "m on the screen per m", Range::nonNegative(),
                 "enlargement of the views for rviz; 0 = the longer side fills 10 m");
  visitor.number("display/height_exaggeration", height_exaggeration, "", Range::nonNegative(),
                 "enlargement of heights against lengths; 0 = chosen for each scan");
  visitor.integer("display/max_points", max_points, Range::within(1, 1e8),
                  "points of surface_points");
  visitor.integer("display/max_markers", max_markers, Range::within(1, 1e6),
                  "discs of asperity_markers");
  visitor.number("display/min_marker_diameter", min_marker_diameter, "m on the screen",
                 Range::nonNegative(),
                 "smaller contacts get discs of this size, so that they are seen");
  visitor.integer("display/max_preview_size", max_preview_size, Range::within(1, 32768),
                  "pixels of the longer side of preview");
  visitor.number("display/preview_range", preview_range, "m", Range::nonNegative(),
                 "height from dark to bright in preview, half of it on either side of the mean, so "
                 "that scans compare; 0 = "
                 "from that which 1 % of the pixels lie below to that of 99 %");
  visitor.flag("display/preview_bar", preview_bar,
               "a bar beside preview with the heights of its greys above the mean; the picture is "
               "then wider");
}

void TransformOptions::describe(OptionVisitor& visitor) {
  visitor.text("counter_surface/frame", frame,
               "tf frame of the counter-surface; empty = counter_surface/pose serves");
  visitor.number("counter_surface/transform_timeout", timeout, "s",
                 Range::within(0.0, kLongestDuration),
                 "how long a scan waits for the transform at its stamp");
}

void NodeOptions::describe(OptionVisitor& visitor) {
  visitor.integer("queue_size", queue_size, Range::within(1, 1000000),
                  "scans that may wait for the worker; with drop_policy all more wait and the "
                  "diagnostics say so");
  visitor.enumeration<DropPolicy>(
      "drop_policy", drop_policy, {{"all", DropPolicy::kAll}, {"latest", DropPolicy::kLatest}},
      "all: every scan is predicted; latest: older scans are dropped and counted");
  visitor.number("max_waiting_memory", max_waiting_memory, "bytes", Range::within(1e6, 1e12),
                 "most that waits in one place, with either drop_policy; older ones beyond it are "
                 "given up and counted");
  visitor.number("max_message_size", max_message_size, "bytes", Range::within(1e3, kLargestMessage),
                 "of an image, a scan_info, a goal or a request; larger ones are rejected before "
                 "they get memory");
  visitor.flag("use_scan_info", use_scan_info,
               "false: the parameters scan/... serve for every scan");
  visitor.number("pairing_timeout", pairing_timeout, "s", kPeriod,
                 "how long a scan and its scan_info wait for each other");
  visitor.flag("accumulate_deformation", accumulate_deformation,
               "each contact leaves its mark on the scans of the same size that follow");
  visitor.integer("max_part_scans", max_part_scans, Range::within(1, 1000),
                  "of one part, kept for the force of its device; of more, the oldest of the "
                  "commonest grid goes");
  visitor.number("max_part_memory", max_part_memory, "bytes", Range::within(1e6, 1e12),
                 "of all scans kept for the force of devices; the part that has waited longest "
                 "goes");
  visitor.number("diagnostic_period", diagnostic_period, "s", kPeriod,
                 "between messages on /diagnostics");
  visitor.number("warning_period", warning_period, "s", Range::within(0.0, kLongestDuration),
                 "at most one warning of a kind about scans in so long a time");
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

StatedConfiguration statedConfiguration(const YAML::Node& tree) {
  StatedConfiguration stated;
  NodeConfiguration& configuration = stated.configuration;
  const auto describe = [&configuration](OptionVisitor& visitor) {
    configuration.describe(visitor);
  };
  std::vector<std::string> violations;
  YAML::Node ours(YAML::NodeType::Map);
  for (const auto& entry : tree) {
    const std::string key = entry.first.Scalar();
    if (key == kTransport) requireRawTransport(entry.second, violations);
    const bool is_text =
        std::find(std::begin(kFileTexts), std::end(kFileTexts), key) != std::end(kFileTexts);
    if (key != kReconfigureParameters && key != kTakenParameters && !is_text &&
        !belongsToImageTransport(key, entry.second)) {
      ours.force_insert(key, entry.second);
    }
  }
  std::set<std::string> in_files;
  for (const char* section : kFileTexts) {
    if (!tree[section]) continue;
    const FileText file(section, tree[section], violations);
    stated.files.push_back(file.name);
    for (const std::string& line : readYaml(file.tree, describe))
      violations.push_back(file.name + ": " + line);
    const std::vector<std::string> keys = keysOf(file.tree);
    in_files.insert(keys.begin(), keys.end());
    placeFilesOf(file, keys, configuration.core, violations);
    for (const std::string& line : emptyPartsOf(file.tree)) {
      configuration.core.remarks.push_back(file.name + ": " + line);
    }
  }
  if (in_files.empty() && tree[kTakenParameters]) {
    for (std::string& line : leftOvers(ours, tree[kTakenParameters].Scalar()))
      violations.push_back(std::move(line));
  }
  if (!violations.empty()) throw OptionsError(std::move(violations));
  if (in_files.empty()) stated.taken = YAML::Dump(YAML::Node(valuesIn(ours)));

  const std::vector<std::string> beside = keysOf(ours);
  const std::string before = toYaml(describe);
  violations = readYaml(ours, describe);
  placeNamedFiles(beside, std::filesystem::current_path(), configuration.core);
  // Combinations of settings; ranges are found by both and named once.
  addMissing(configuration.core.validate(), violations);
  if (!configuration.node.transform.frame.empty() &&
      !isIdentity(configuration.core.counter_surface.pose)) {
    violations.push_back(
        "counter_surface/frame: " + configuration.node.transform.frame +
        " is not allowed with a counter_surface/pose other than 0; must be empty, or the pose 0");
  }
  if (!violations.empty()) throw OptionsError(std::move(violations));

  if (!in_files.empty() && before != toYaml(describe)) stated.overrides = beside;
  for (const std::string& key : beside) in_files.erase(key);
  stated.from_files.assign(in_files.begin(), in_files.end());
  return stated;
}

namespace {

/// The node's first line: a launch file's argument that is misspelt, or forgotten, leaves the
/// default in its place.
void tellSource(const ros::NodeHandle& private_handle, const StatedConfiguration& stated) {
  const Configuration& core = stated.configuration.core;
  const bool may_read = filesElsewhere(core, scanFolders()).empty();
  const std::string hash = may_read ? settingsHash(core) : "with files from elsewhere";
  std::string files;
  for (const std::string& file : stated.files)
    files += (files.empty() ? "" : ", then ") + oneLine(file);
  ROS_INFO_STREAM("configuration: " << (files.empty()
                                            ? "no file, the defaults and parameters under " +
                                                  private_handle.getNamespace()
                                            : files)
                                    << "; settings " << hash);
}

}  // namespace

NodeConfiguration readParameters(const ros::NodeHandle& private_handle) {
  XmlRpc::XmlRpcValue tree;
  if (!private_handle.getParam(private_handle.getNamespace(), tree)) {
    tellSource(private_handle, {});
    return {};
  }
  if (tree.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    throw OptionsError({private_handle.getNamespace() +
                        ": a single value is not allowed, must be a map of settings"});
  }
  const StatedConfiguration stated = statedConfiguration(yamlFromParameters(tree));
  tellSource(private_handle, stated);
  if (!stated.taken.empty()) {
    setParameterAtStart(private_handle.resolveName(kTakenParameters), stated.taken);
  }
  visitValues(stated.configuration, [&](const std::string& key,
                                        const auto& value) {  // with the types of the settings
    const bool is_from_file = std::find(stated.from_files.begin(), stated.from_files.end(), key) !=
                              stated.from_files.end();
    if (is_from_file) setParameterAtStart(private_handle.resolveName(key), value);
  });
  if (!stated.overrides.empty()) {
    std::string keys;
    for (const std::string& key : stated.overrides) keys += " " + key;
    ROS_INFO_STREAM("parameters under " << private_handle.getNamespace()
                                        << " that go before the configuration files:" << keys);
  }
  return stated.configuration;
}

}  // namespace mems_stiction
