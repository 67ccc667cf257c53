#pragma once

/// Is a bag what it says of its own lengths? rosbag believes them, and reads behind its memory
/// where they lie.

#include <string>

namespace mems_stiction {

/// How much of a bag is there.
enum class BagEnd { kWhole, kCutOff };

/// Walks through all records of a bag of version 2.0 (http://wiki.ros.org/Bags/Format/2.0), those
/// inside uncompressed chunks too; what compressed chunks contain is left to rosbag.
/// @throw FileError naming the bag, the byte and what is wrong there
BagEnd checkBag(const std::string& path);

}  // namespace mems_stiction
