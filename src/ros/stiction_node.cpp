/// The node: constructs the server and runs until ROS ends. Exit 1 with one line per bad parameter.

#include <cstdlib>

#include <ros/ros.h>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/ros/stiction_server.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "stiction_node");
  // Outlive the server: with the last handle ROS shuts down, and its log with it.
  const ros::NodeHandle handle;
  const ros::NodeHandle private_handle("~");
  try {
    const mems_stiction::StictionServer server(handle, private_handle, ros::this_node::getName());
    ros::waitForShutdown();
  } catch (const mems_stiction::OptionsError& error) {
    for (const std::string& line : error.violations()) ROS_FATAL_STREAM("parameter ~" << line);
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
