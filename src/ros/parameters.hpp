#pragma once

/// @file
/// The parameters of node and nodelet: the core's configuration and the node's own settings, read
/// from the private namespace by the same tables and the same reader as a configuration file.

#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace YAML {
class Node;
}

namespace mems_stiction {

/// What happens when scans arrive faster than they can be predicted.
enum class DropPolicy {
  kAll,     ///< every scan waits for its turn: a replay gives as many predictions as scans
  kLatest,  ///< the newest queue_size scans wait, older ones are dropped and counted: a live view
            ///< stays live
};

/// The views for rviz, which cannot show micrometres: everything is enlarged by `scale`, heights
/// once more.
struct DisplayOptions {
  std::string frame = "stiction_view";  ///< frame_id of the views; empty = the scan's
  double scale = 0.0;  ///< metres on the screen for one metre of the scan [-]; 0 = kViewSize fits
  double height_exaggeration = 0.0;  ///< of heights against lengths [-]; 0 = chosen for each scan
  int max_points =
      40000;  ///< of surface_points; the surface is thinned out in rows and columns to keep it
  int max_markers = 500;  ///< of asperity_markers; the contacts with the largest loads are shown
  double min_marker_diameter =
      0.1;  ///< of a disc on the screen, so that small contacts are seen [m], >= 0
  int max_preview_size = 512;  ///< pixels of the longer side of preview
  double preview_range =
      0.0;  ///< height from dark to bright, about the mean [m]; 0 = by each scan's own heights
  bool preview_bar = false;  ///< beside the preview stands which grey is which height

  void describe(OptionVisitor& visitor);
};

/// The longer side of a scan on the screen [m], where DisplayOptions::scale does not say otherwise.
inline constexpr double kViewSize = 10.0;

/// Where the counter-surface lies over each scan, by tf2.
struct TransformOptions {
  std::string frame;     ///< of the counter-surface; empty = off, counter_surface/pose serves
  double timeout = 0.5;  ///< how long a scan waits for its transform [s], wall time

  void describe(OptionVisitor& visitor);
};

/// Settings of the node itself.
struct NodeOptions {
  int queue_size =
      10;  ///< scans that may wait for the worker; with DropPolicy::kAll more wait, with a warning
  DropPolicy drop_policy = DropPolicy::kAll;
  double max_waiting_memory = 4e9;  ///< of what waits in one place, see doc/ros_api.md [bytes]
  double max_message_size = 1e9;  ///< of what comes on a topic or by a service, as it came [bytes]
  bool use_scan_info = true;      ///< false: the parameters scan/... serve for every scan
  double pairing_timeout =
      5.0;  ///< how long a scan and its scan_info wait for each other [s], wall time
  bool accumulate_deformation = false;  ///< each contact leaves its mark on the scans that follow
  int max_part_scans = 16;              ///< of one part, kept for the force of its device, > 0
  double max_part_memory = 1e9;         ///< of all scans that are kept for it [bytes]
  double diagnostic_period = 1.0;       ///< between messages on /diagnostics [s], wall time
  double warning_period = 5.0;  ///< at most one warning of a kind in so long a time [s], wall time
  TransformOptions transform;
  DisplayOptions display;

  void describe(OptionVisitor& visitor);
};

/// The whole private namespace.
struct NodeConfiguration {
  Configuration core;
  NodeOptions node;

  void describe(OptionVisitor& visitor);
};

/// A tree of parameters as YAML.
/// @throw OptionsError naming the key of a value that YAML has no form for (dates, binary data).
YAML::Node yamlFromParameters(XmlRpc::XmlRpcValue tree);

/// What a namespace says.
struct StatedConfiguration {
  NodeConfiguration configuration;
  std::vector<std::string>
      from_files;     ///< keys that the text of a configuration file states, and nothing else
  std::string taken;  ///< without files: all that was stated, for the next start to compare with
  std::vector<std::string> files;      ///< that such texts are of
  std::vector<std::string> overrides;  ///< keys that stand beside such texts and go before them
};

/// Texts of configuration files, `node_config/text` and `config/text` (their names: `.../file`),
/// are read as predict_scan reads the file, the second over the first. The other keys go before
/// both. Without such texts, what an earlier run has taken and left (`taken_at_start`) must not mix
/// with what was set since.
/// @param tree a map; keys of image_transport's own (`image_transport`,
/// `<topic>/disable_pub_plugins`,
///        `<topic>/<plugin>/...`) and the mirror of dynamic_reconfigure are passed over.
/// @throw OptionsError one line per unknown key, key given twice, wrong type, unphysical value or
/// combination; lines
///        about a file name it.
StatedConfiguration statedConfiguration(const YAML::Node& tree);

/// Reads the private namespace, and puts what files state beside their texts, where scripts look
/// for it.
/// @throw OptionsError as above.
NodeConfiguration readParameters(const ros::NodeHandle& private_handle);

}  // namespace mems_stiction
