#pragma once

/// @file
/// The parameters of scan_source, read from its private namespace by the same tables as a
/// configuration file.

#include <string>

#include <ros/node_handle.h>

#include "mems_stiction/height_map/raw_scan.hpp"
#include "mems_stiction/height_map/scan_identity.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "source/cloud_grid.hpp"

namespace YAML {
class Node;
}

namespace mems_stiction {

/// What lay in the folder before the first start.
enum class OldFiles {
  kAll,     ///< is published
  kNewest,  ///< one of it is
  kNone,    ///< is passed over
};

/// Where scans come from.
enum class SourceKind {
  kFolder,   ///< files that an instrument's program writes
  kCloud,    ///< clouds of points, a whole field each
  kGridMap,  ///< maps of the package grid_map
  kLines,    ///< clouds of points, a line each
};

/// The door `folder`.
struct FolderOptions {
  std::string folder;                   ///< that is watched
  std::string patterns;                 ///< of names, with commas between them; empty = all
  bool recursive = false;               ///< folders below it, too
  double settle_time = 1.0;             ///< a file that did not change for so long is whole [s]
  double poll_period = 2.0;             ///< between looks where the system tells of no change [s]
  OldFiles old_files = OldFiles::kAll;  ///< at the first start, when there is no state file
  std::string name_pattern;             ///< regular expression with named groups
  double site_scale = 1e-3;             ///< of site_x and site_y in names [m per unit]
  std::string state_file;               ///< which contents were published; empty = below ROS_HOME
  std::string channel;                  ///< to take; empty = the likeliest height channel

  void describe(OptionVisitor& visitor);
};

/// The doors `cloud` and `grid_map`.
struct PointsOptions {
  CloudOptions map;
  std::string layer = "elevation";  ///< of a grid map
  std::string frame;               ///< of tf, that heights are taken in; empty = that of the points
  double transform_timeout = 0.5;  ///< how long points wait for their transform [s]
  int queue_size = 10;             ///< clouds that wait; older ones are given up

  void describe(OptionVisitor& visitor);
};

/// What tells where a line was taken.
enum class Motion { kCount, kSpeed, kJoint, kTf };

/// The door `lines`, beside what it has in common with `cloud`.
struct LineOptions {
  Motion motion = Motion::kTf;
  double line_pitch = 0.0;   ///< between lines [m]; 0 = their median distance
  double speed = 0.0;        ///< of the stage along y [m/s]
  std::string joint;         ///< of the stage
  double joint_scale = 1.0;  ///< [m per unit of its position]
  double backlash = 0.0;     ///< that lines of a stage that goes back lie too far back [m]
  int max_lines = 0;         ///< of a scan; 0 = any number
  bool end_at_turn = false;  ///< a scan ends where the stage turns back
  double pause = 0.0;        ///< a scan ends when nothing comes or moves for so long [s]; 0 = never

  void describe(OptionVisitor& visitor);
};

/// The whole private namespace.
struct SourceOptions {
  SourceKind source = SourceKind::kFolder;
  std::string listener;  ///< node without which nothing is published; empty = anybody will do
  std::string audience;  ///< nodes that the first scan waits for, with commas between them
  double audience_timeout = 30.0;  ///< so long at most [s]
  int max_ahead = 20;            ///< scans beyond those that the node has answered; 0 = any number
  double answer_timeout = 60.0;  ///< the node's answer is waited for no longer [s]
  double diagnostic_period = 1.0;  ///< between messages on /diagnostics [s]
  FolderOptions folder;
  PointsOptions points;
  LineOptions lines;
  ScanOptions scan;       ///< what files do not state of themselves
  ScanIdentity identity;  ///< what neither file nor name states, and of clouds

  /// All but the keys `scan/...`, which describe themselves.
  void describe(OptionVisitor& visitor);
};

/// Of the private namespace as a map. `config/text`, the text of the node's configuration
/// (`config/file` its name), may be among it: its `scan/...` serve where the source states none.
/// @throw OptionsError one line per unknown key, wrong type or value out of range
SourceOptions statedSourceOptions(YAML::Node tree);

/// As above, of the parameter server.
SourceOptions readSourceParameters(const ros::NodeHandle& private_handle);

}  // namespace mems_stiction
