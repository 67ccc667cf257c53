#pragma once

/// @file
/// What a message takes while it waits, with its texts.

#include <cstddef>

#include <ros/serialization.h>

namespace mems_stiction {

/// - @p message may be null
template <typename MessagePointer>
std::size_t bytesOf(const MessagePointer& message) {
  return message ? ros::serialization::serializationLength(*message) : 0;
}

}  // namespace mems_stiction
