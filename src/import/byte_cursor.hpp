#pragma once

/// @file
/// Numbers and texts out of the bytes of a file; every read checks what is left first.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <string>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {

/// A number of 16 bits by IEEE 754.
inline double halfToFloat(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const int fraction = bits & 1023;
  double value =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(fraction + 1024, exponent - 25);
  if (exponent == 31) {
    value = fraction == 0 ? std::numeric_limits<double>::infinity()
                          : std::numeric_limits<double>::quiet_NaN();
  }
  return bits >> 15 != 0 ? -value : value;
}

enum class ByteOrder { kLittle, kBig };

/// A view of bytes that are not read yet. Copies read on by themselves.
class ByteCursor {
 public:
  /// - @p what for messages: "the .gwy container" ends in the middle of something
  ByteCursor(const char* begin, std::size_t size, const char* what,
             ByteOrder order = ByteOrder::kLittle)
      : data_(begin), size_(size), what_(what), order_(order) {}

  bool atEnd() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  const char* take(std::size_t count) {
    if (count > size_) throw FileError(std::string(what_) + " ends too early: cut off or damaged");
    const char* start = data_;
    data_ += count;
    size_ -= count;
    return start;
  }

  ByteCursor part(std::size_t count) { return {take(count), count, what_, order_}; }

  /// `count` items of `item_size` bytes, without overflow.
  ByteCursor array(std::size_t count, std::size_t item_size) {
    if (item_size > 0 && count > size_ / item_size) take(size_ + 1);
    return part(count * item_size);
  }

  /// Up to a NUL, which is read too.
  std::string text() {
    const auto length = static_cast<std::size_t>(std::find(data_, data_ + size_, '\0') - data_);
    if (length == size_) take(size_ + 1);
    std::string value(data_, length);
    take(length + 1);
    return value;
  }

  /// A field of fixed width, without the blanks and NULs at its end.
  std::string field(std::size_t width) {
    std::string value(take(width), width);
    value.erase(std::min(value.find('\0'), value.size()));
    value.erase(value.find_last_not_of(" \r\n\t") + 1);
    return value;
  }

  /// An integer or a floating-point number in the file's byte order.
  template <typename Number>
  Number number() {
    unsigned char bytes[sizeof(Number)];
    std::memcpy(bytes, take(sizeof(Number)), sizeof(Number));
    constexpr ByteOrder kMachine =
        __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? ByteOrder::kBig : ByteOrder::kLittle;
    if (order_ != kMachine) std::reverse(std::begin(bytes), std::end(bytes));
    Number value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

 private:
  const char* data_;
  std::size_t size_;
  const char* what_;
  ByteOrder order_;
};

}  // namespace mems_stiction
