/// The node: constructs the server and runs until ROS ends (node_program.hpp).

#include "node_program.hpp"
#include "ros/stiction_server.hpp"

int main(int argc, char** argv) {
  return mems_stiction::runNode(
      argc, argv,
      {"stiction_node",
       "Predicts each scan that comes on the topic height; doc/ros_api.md. Settings are parameters "
       "of the node: start it by\n"
       "  roslaunch mems_stiction stiction.launch config:=/path/to/device.yaml\n"
       "or set single ones by _KEY:=VALUE; __name:=NAME gives it another name.",
       "the node", true,
       [](const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
          const std::string& node) {
         return std::make_shared<mems_stiction::StictionServer>(handle, private_handle, node);
       }});
}
