#pragma once

/// Choices out of the bytes of an input, until they are used up: then zeros. libFuzzer's own
/// FuzzedDataProvider comes with clang only, and the inputs of the corpora are read by every
/// compiler's build.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace mems_stiction::fuzzing {

class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  std::size_t left() const { return left_; }

  template <typename Value>
  Value take() {
    Value value{};
    const std::size_t count = left_ < sizeof(Value) ? left_ : sizeof(Value);
    if (count > 0) std::memcpy(&value, data_, count);
    data_ += count;
    left_ -= count;
    return value;
  }

  /// From 0 to count - 1. - @p count 1 to 256
  std::size_t below(std::size_t count) { return take<std::uint8_t>() % count; }

  /// From 0 to 1 in 65536 steps.
  double share() { return take<std::uint16_t>() / 65535.0; }

  std::string rest() {
    const std::string text(reinterpret_cast<const char*>(data_), left_);
    left_ = 0;
    return text;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace mems_stiction::fuzzing
