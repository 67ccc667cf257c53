#pragma once

/// @file
/// What the programs that are nodes have in common: the command line, one node of a name, signals,
/// and an end in seconds whatever the master does.

#include <functional>
#include <memory>
#include <string>

#include <ros/node_handle.h>

namespace mems_stiction {

/// One of them.
struct NodeProgram {
  std::string name;         ///< of the program, and of its node unless __name says another
  std::string description;  ///< for --help
  std::string what;         ///< "the node": in what it says of itself
  bool may_take_over;       ///< has --take-over: ends a node of its name and takes its place
  /// Makes what runs until the end; its destructor finishes the scan at hand.
  /// @throw OptionsError one line per bad parameter; whatever else is thrown is a reason, too
  std::function<std::shared_ptr<void>(const ros::NodeHandle& handle,
                                      const ros::NodeHandle& private_handle,
                                      const std::string& node)>
      start;
};

/// The whole of main(): runs until ROS ends, by a shutdown, INT, TERM or HUP. All of them let it
/// finish the scan at hand and take its name off the master, in 4 s at most.
/// @return the exit status: 0 ended, 1 it cannot start, or a node of its name runs, 2 bad command
/// line
int runNode(int argc, char** argv, const NodeProgram& program);

}  // namespace mems_stiction
