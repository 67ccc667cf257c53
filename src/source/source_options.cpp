#include "source/source_options.hpp"

#include <algorithm>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "ros/parameters.hpp"
#include "settings/option_yaml.hpp"
#include "settings/yaml_text.hpp"

namespace mems_stiction {
namespace {

/// A list of texts as one text.
void joinList(YAML::Node& tree, const std::string& key) {
  if (!tree[key].IsDefined() || !tree[key].IsSequence()) return;
  std::string joined;
  for (const YAML::Node& entry : tree[key])
    joined += (joined.empty() ? "" : ",") + entry.as<std::string>("");
  tree[key] = joined;
}

/// What the node's configuration states of scans goes for the source, too, behind its own keys: the
/// text `config/text`, named `config/file`.
void takeScanOfConfiguration(YAML::Node& tree) {
  const YAML::Node config = tree["config"];
  if (!config.IsDefined()) return;
  const std::string file = config["file"].as<std::string>("config/text");
  const YAML::Node stated = parseYaml(config["text"].as<std::string>(""), file);
  tree.remove("config");
  const std::vector<std::string> own = keysOf(tree);
  for (const auto& [key, value] : statedIn(stated)) {
    if (startsWith(key, "scan/") && std::find(own.begin(), own.end(), key) == own.end())
      tree[key] = value;
  }
}

/// What a motion cannot do without.
void complainOfMotion(const SourceOptions& options, std::vector<std::string>& complaints) {
  const LineOptions& lines = options.lines;
  const auto need = [&](Motion motion, bool is_stated, const std::string& what) {
    if (lines.motion == motion && !is_stated)
      complaints.push_back(what + " must be stated with this motion");
  };
  need(Motion::kCount, lines.line_pitch > 0.0, "line_pitch: 0 is not allowed,");
  need(Motion::kSpeed, lines.speed != 0.0, "speed: 0 is not allowed,");
  need(Motion::kJoint, !lines.joint.empty(), "joint: empty is not allowed,");
  need(Motion::kTf, !options.points.frame.empty(), "frame: empty is not allowed,");
}

std::vector<std::string> complaintsOf(const SourceOptions& options) {
  std::vector<std::string> lines;
  if (options.source == SourceKind::kLines) complainOfMotion(options, lines);
  if (options.source == SourceKind::kFolder && options.folder.folder.empty()) {
    lines.emplace_back(
        "folder: is not stated, must be the folder that the instrument's program writes into");
  }
  if (!(options.points.map.invalid_below < options.points.map.invalid_above)) {
    lines.push_back("invalid_below: " + numberText(options.points.map.invalid_below) +
                    " is not allowed, must be below invalid_above");
  }
  for (const std::string& line : identityComplaints(options.identity, "scan/"))
    lines.push_back(line);
  if (options.scan.height_scale == 0.0)
    lines.emplace_back("scan/height_scale: 0 is not allowed, must not be 0");
  return lines;
}

/// What is stated of files in vain: points are in metres, on the grid of pitch_x and pitch_y.
void complainOfFiles(const std::vector<std::string>& own, std::vector<std::string>& complaints) {
  for (const char* key : {"scan/pitch_x", "scan/pitch_y", "scan/height_scale"}) {
    if (std::find(own.begin(), own.end(), key) == own.end()) continue;
    complaints.push_back(key + std::string(": is of files, and points are in metres: leave it out "
                                           "(pitch_x and pitch_y state the grid of a map)"));
  }
}

}  // namespace

void FolderOptions::describe(OptionVisitor& visitor) {
  visitor.text("folder", folder, "that the instrument's program writes its files into");
  visitor.text("patterns", patterns,
               "names of scans, a list or a text with commas: *.spm,*.di; empty = all but hidden "
               "and temporary ones");
  visitor.flag("recursive", recursive, "folders below it are watched, too");
  visitor.number("settle_time", settle_time, "s", Range::within(0.0, 3600.0),
                 "a file that did not change for so long is whole");
  visitor.number(
      "poll_period", poll_period, "s", Range::within(0.05, 3600.0),
      "between looks at folders of which the system tells no change, as on network shares");
  visitor.enumeration<OldFiles>(
      "old_files", old_files,
      {{"all", OldFiles::kAll}, {"newest", OldFiles::kNewest}, {"none", OldFiles::kNone}},
      "which of the files that lie there at the first start are published");
  visitor.text("name_pattern", name_pattern,
               "regular expression over the name below the folder, with named groups: part_id, "
               "serial_id, lot_id, "
               "wafer_id, site_x, site_y; a sidecar goes before it");
  visitor.number("site_scale", site_scale, "m per unit", Range::positive(),
                 "of site_x and site_y in names");
  visitor.text("state_file", state_file,
               "remembers which contents were published; empty = below ~/.ros, by the node's name "
               "and the folder");
  visitor.text("channel", channel,
               "title or number of the channel to take; empty = the likeliest height channel");
}

void PointsOptions::describe(OptionVisitor& visitor) {
  const Range pitch = Range::within(0.0, 1.0);
  visitor.number("pitch_x", map.pitch_x, "m", pitch,
                 "of the map that points become; 0 = that of the points");
  visitor.number("pitch_y", map.pitch_y, "m", pitch,
                 "of the map that points become; 0 = that of the points");
  visitor.enumeration<bool>("up", map.is_up_negative, {{"z", false}, {"-z", true}},
                            "where heights grow");
  visitor.enumeration<Mirror>(
      "mirror", map.mirror,
      {{"auto", Mirror::kAuto}, {"x", Mirror::kX}, {"y", Mirror::kY}, {"none", Mirror::kNone}},
      "the axis that a left-handed sensor has the wrong way round; auto = y with up: -z, as of a "
      "sensor that is turned "
      "over, else none");
  visitor.number("invalid_below", map.invalid_below, "m", Range::any(),
                 "points with a lower z are not measured");
  visitor.number("invalid_above", map.invalid_above, "m", Range::any(),
                 "points with a higher z are not measured");
  visitor.number("grid_tolerance", map.grid_tolerance, "-", Range::within(0.0, 0.5),
                 "how far points may lie from their places on an even grid, over its pitch");
  visitor.text("layer", layer, "of a grid map, that the heights [m] are in");
  visitor.text("frame", frame, "tf frame that heights are taken in; empty = that of the points");
  visitor.number("transform_timeout", transform_timeout, "s", Range::within(0.0, 1e6),
                 "how long points wait for the transform at their stamp");
  visitor.integer("queue_size", queue_size, Range::within(1, 1e6),
                  "clouds that may wait; beyond, the oldest are refused");
}

void LineOptions::describe(OptionVisitor& visitor) {
  visitor.enumeration<Motion>("motion", motion,
                              {{"count", Motion::kCount},
                               {"speed", Motion::kSpeed},
                               {"joint", Motion::kJoint},
                               {"tf", Motion::kTf}},
                              "what tells where a line was taken");
  visitor.number("line_pitch", line_pitch, "m", Range::within(0.0, 1.0),
                 "between lines; 0 = their median distance");
  visitor.number("speed", speed, "m/s", Range::any(), "of the stage along y, with motion: speed");
  visitor.text("joint", joint, "of the stage in joint_states, with motion: joint");
  visitor.number("joint_scale", joint_scale, "m per unit", Range::any(), "of the joint's position");
  visitor.number("backlash", backlash, "m", Range::any(),
                 "that lines of a stage that goes back lie too far back");
  visitor.integer("max_lines", max_lines, Range::within(0, 1e6),
                  "a scan ends with so many; 0 = any number");
  visitor.flag("end_at_turn", end_at_turn, "a scan ends where the stage turns back");
  visitor.number("pause", pause, "s", Range::within(0.0, 1e6),
                 "a scan ends when no line comes, or nothing moves, for so long; 0 = never");
}

void SourceOptions::describe(OptionVisitor& visitor) {
  visitor.enumeration<SourceKind>("source", source,
                                  {{"folder", SourceKind::kFolder},
                                   {"cloud", SourceKind::kCloud},
                                   {"grid_map", SourceKind::kGridMap},
                                   {"lines", SourceKind::kLines}},
                                  "where scans come from");
  visitor.text("listener", listener,
               "node that must listen before a scan is published, of nodelets their manager; empty "
               "= anybody will do");
  visitor.text("audience", audience,
               "nodes that must listen to scan_info before the first scan is published, as a "
               "recorder and a page that start beside the source; a list or a text with commas");
  visitor.number("audience_timeout", audience_timeout, "s", Range::within(0.0, 1e6),
                 "the first scan waits no longer for the audience");
  visitor.integer(
      "max_ahead", max_ahead, Range::within(0, 1e6),
      "scans that are published beyond those that the node has answered; 0 = any number");
  visitor.number(
      "answer_timeout", answer_timeout, "s", Range::within(0.01, 1e9),
      "a scan that got no prediction for so long counts as answered, as one that was rejected");
  visitor.number("diagnostic_period", diagnostic_period, "s", Range::within(0.01, 1e9),
                 "between messages on /diagnostics");
  folder.describe(visitor);
  points.describe(visitor);
  lines.describe(visitor);
}

SourceOptions statedSourceOptions(YAML::Node tree) {
  const std::vector<std::string> own = keysOf(tree);
  takeScanOfConfiguration(tree);
  joinList(tree, "patterns");
  joinList(tree, "audience");
  SourceOptions options;
  std::vector<std::string> violations = readYaml(tree, [&](OptionVisitor& visitor) {
    options.describe(visitor);
    options.scan.describe(visitor);
    options.identity.describe(visitor);
  });
  if (violations.empty()) violations = complaintsOf(options);
  if (options.source != SourceKind::kFolder) complainOfFiles(own, violations);
  if (!violations.empty()) throw OptionsError(std::move(violations));
  return options;
}

SourceOptions readSourceParameters(const ros::NodeHandle& private_handle) {
  XmlRpc::XmlRpcValue parameters;
  YAML::Node tree(YAML::NodeType::Map);
  if (private_handle.getParam(private_handle.getNamespace(), parameters) &&
      parameters.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
    tree = yamlFromParameters(parameters);
  }
  return statedSourceOptions(tree);
}

}  // namespace mems_stiction
