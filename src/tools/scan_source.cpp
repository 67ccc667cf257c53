/// The program: opens the source and runs until ROS ends (node_program.hpp).

#include "source/scan_source.hpp"
#include "node_program.hpp"

int main(int argc, char** argv) {
  return mems_stiction::runNode(
      argc, argv,
      {"scan_source",
       "Publishes each scan that an instrument gives on the topics height and scan_info; "
       "doc/instruments.md. Settings are\nparameters of the node: start it by\n"
       "  roslaunch mems_stiction station.launch config:=/path/to/device.yaml "
       "folder:=/path/to/scans",
       "the source", false,
       [](const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
          const std::string& node) {
         return std::make_shared<mems_stiction::ScanSource>(handle, private_handle, node);
       }});
}
