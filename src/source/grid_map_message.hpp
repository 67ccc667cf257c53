#pragma once

/// @file
/// grid_map_msgs/GridMap of the package grid_map (ANYbotics, BSD licence; ROS 1, any release), as
/// far as roscpp needs to know it: its fields in their order, its name, and the checksum of its
/// definition. Debian has no package of it. Adapted like this, the message needs none, neither to
/// build nor to run, and a publisher with another definition is turned away by its checksum
/// (http://wiki.ros.org/roscpp/Overview/MessagesSerializationAndAdaptingTypes).

#include <cstdint>
#include <string>
#include <vector>

#include <geometry_msgs/Pose.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Header.h>

namespace mems_stiction {

/// grid_map_msgs/GridMapInfo, then the fields of grid_map_msgs/GridMap.
struct GridMapMessage {
  std_msgs::Header header;
  double resolution = 0.0;   ///< [m per cell]
  double length_x = 0.0;     ///< [m]
  double length_y = 0.0;     ///< [m]
  geometry_msgs::Pose pose;  ///< of the middle of the map, in the frame of the header
  std::vector<std::string> layers;
  std::vector<std::string> basic_layers;          ///< a cell counts where all of them are finite
  std::vector<std_msgs::Float32MultiArray> data;  ///< of each layer
  std::uint16_t outer_start_index = 0;            ///< row at which the circular buffer begins
  std::uint16_t inner_start_index = 0;            ///< column at which it begins
};

}  // namespace mems_stiction

namespace ros {
namespace message_traits {

/// That of the definition in grid_map_msgs.
template <>
struct MD5Sum<mems_stiction::GridMapMessage> {
  static const char* value() { return "95681e052b1f73bf87b7eb984382b401"; }
  static const char* value(const mems_stiction::GridMapMessage&) { return value(); }
};

/// The name by which publishers and bags know it.
template <>
struct DataType<mems_stiction::GridMapMessage> {
  static const char* value() { return "grid_map_msgs/GridMap"; }
  static const char* value(const mems_stiction::GridMapMessage&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

/// Reads and writes its fields in the order of the definition.
template <>
struct Serializer<mems_stiction::GridMapMessage> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.resolution);
    stream.next(message.length_x);
    stream.next(message.length_y);
    stream.next(message.pose);
    stream.next(message.layers);
    stream.next(message.basic_layers);
    stream.next(message.data);
    stream.next(message.outer_start_index);
    stream.next(message.inner_start_index);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros
