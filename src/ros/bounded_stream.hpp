#pragma once

/// @file
/// Reads a message that a peer has sent, and believes nothing that the message states of its own
/// lengths.
///
/// roscpp makes room for all elements that an array states before it looks whether they are there:
/// a message of 43 bytes takes 4 GB, and the node is deaf until they are written. Here an array
/// gets room for what can follow, and no more.

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <ros/serialization.h>

namespace mems_stiction {

/// A message is shorter than it states, or larger than is taken.
class MessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// As ros::serialization::IStream, for every type of message that is generated.
class BoundedStream : public ros::serialization::Stream {
 public:
  // NOLINTNEXTLINE(readability-identifier-naming): the name that generated messages ask for
  static constexpr ros::serialization::StreamType stream_type =
      ros::serialization::stream_types::Input;

  /// - @p bytes of the message, which must outlive the stream
  BoundedStream(std::uint8_t* bytes, std::uint32_t size) : Stream(bytes, size) {}

  template <typename Value>
  void next(Value& value) {
    ros::serialization::deserialize(*this, value);
  }

  /// @throw MessageError if so many elements cannot follow
  template <typename Element, typename Allocator>
  void next(std::vector<Element, Allocator>& list) {
    std::uint32_t count = 0;
    next(count);
    const std::uint64_t least =
        ros::serialization::serializationLength(Element());  // lists and texts in it are empty
    if (count * least > getLength()) {
      throw MessageError("a list of the message states " + std::to_string(count) +
                         " elements of at least " + std::to_string(least) + " bytes, but only " +
                         std::to_string(getLength()) + " bytes follow");
    }
    list.resize(count);
    if constexpr (ros::message_traits::IsSimple<Element>::value) {
      const std::uint32_t size = count * static_cast<std::uint32_t>(sizeof(Element));
      if (size > 0) std::memcpy(list.data(), advance(size), size);
    } else {
      for (Element& element : list) next(element);
    }
  }
};

/// The message that these bytes are.
/// - @p bytes are read only
/// @throw MessageError if they end before the message does
template <typename Message>
void readMessage(std::uint8_t* bytes, std::uint32_t size, Message& message) {
  BoundedStream stream(bytes, size);
  try {
    stream.next(message);
  } catch (const ros::serialization::StreamOverrunException&) {
    throw MessageError("the message has " + std::to_string(size) + " bytes, fewer than it states");
  }
}

/// The first parts of a message, such as its header, as far as the bytes hold them; what cannot be
/// read stays as it is.
template <typename... Parts>
void readBeginning(BoundedStream bytes, Parts&... parts) {
  try {
    (bytes.next(parts), ...);
  } catch (const std::exception&) {  // no more of them is known
  }
}

}  // namespace mems_stiction
