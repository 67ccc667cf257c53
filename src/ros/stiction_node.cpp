/// The node: constructs the server and runs until ROS ends, by a shutdown, INT, TERM or HUP: all of them let it finish the
/// scan at hand and take its name off the master. Exit 1 with one line per bad parameter.

#include <csignal>
#include <cstdlib>

#include <ros/ros.h>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/ros/stiction_server.hpp"

namespace {

/// What roscpp does for INT; it leaves TERM and HUP to their defaults, which end a process without a word to the master.
void requestShutdown(int /*signal*/) { ros::requestShutdown(); }

void shutDownOn(int number) {
  if (std::signal(number, requestShutdown) == SIG_IGN) std::signal(number, SIG_IGN);  // nohup stays
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "stiction_node");
  shutDownOn(SIGTERM);
  shutDownOn(SIGHUP);
  // Outlive the server: with the last handle ROS shuts down, and its log with it.
  const ros::NodeHandle handle;
  const ros::NodeHandle private_handle("~");
  try {
    const mems_stiction::StictionServer server(handle, private_handle, ros::this_node::getName());
    ros::waitForShutdown();
  } catch (const mems_stiction::OptionsError& error) {
    for (const std::string& line : error.violations()) ROS_FATAL_STREAM("parameter ~" << line);
    return EXIT_FAILURE;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("the node cannot start: " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
