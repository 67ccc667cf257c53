#pragma once

/// Is a bag what it says of its own lengths? rosbag believes them, and reads behind its memory
/// where they lie.

#include <cstdint>
#include <string>

namespace mems_stiction {

/// How much of a bag is there.
enum class BagEnd { kWhole, kCutOff };

/// Of a bag that was cut off inside its index, where the index begins: all messages stand before
/// it. 0 for one that was cut off before, or never ended.
/// @throw FileError as checkBag()
std::uint64_t cutIndexPlace(const std::string& path);

/// Walks through all records of a bag of version 2.0 (http://wiki.ros.org/Bags/Format/2.0), those
/// inside uncompressed chunks too; what compressed chunks contain is left to rosbag.
/// @throw FileError naming the bag, the byte and what is wrong there
BagEnd checkBag(const std::string& path);

}  // namespace mems_stiction
