#pragma once

/// @file
/// Eight single-precision numbers that a pass takes at once, beside the four doubles of packet.hpp.

#include <cstddef>
#include <cstring>

#include "numeric/vectorized.hpp"

namespace mems_stiction {

/// Eight floats. Every operator is that of the eight numbers, to the bit. The alignment is written
/// out: in memory it would else depend on the instructions a file is compiled for.
class alignas(32) FloatPacket {
 public:
  static constexpr std::size_t kCount = 8;

  /// 0 in all packets.
  MEMS_STICTION_INLINE FloatPacket() : values_{} {}
  // NOLINTNEXTLINE(modernize-use-equals-default): as that of Packet
  MEMS_STICTION_INLINE FloatPacket(const FloatPacket& other) : values_(other.values_) {}
  FloatPacket& operator=(const FloatPacket& other) = default;

  /// From memory.
  MEMS_STICTION_INLINE static FloatPacket load(const float* values) {
    Vector loaded;
    std::memcpy(&loaded, values, sizeof loaded);
    return FloatPacket(loaded);
  }
  /// To memory.
  MEMS_STICTION_INLINE void store(float* values) const {
    std::memcpy(values, &values_, sizeof values_);
  }

  friend MEMS_STICTION_INLINE FloatPacket operator+(const FloatPacket& a, const FloatPacket& b) {
    return FloatPacket(a.values_ + b.values_);
  }
  friend MEMS_STICTION_INLINE FloatPacket operator-(const FloatPacket& a, const FloatPacket& b) {
    return FloatPacket(a.values_ - b.values_);
  }
  friend MEMS_STICTION_INLINE FloatPacket operator*(const FloatPacket& a, const FloatPacket& b) {
    return FloatPacket(a.values_ * b.values_);
  }
  friend MEMS_STICTION_INLINE FloatPacket operator*(const FloatPacket& a, float factor) {
    return FloatPacket(a.values_ * factor);
  }

  /// Eight times eight numbers: what was element j of line i is then element i of line j.
  friend MEMS_STICTION_INLINE void transpose(FloatPacket (&lines)[kCount]) {
    Vector pairs[kCount];
    for (std::size_t i = 0; i < kCount; i += 2) {
      const Vector& a = lines[i].values_;
      const Vector& b = lines[i + 1].values_;
      pairs[i] = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
      pairs[i + 1] = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    }
    Vector fours[kCount];
    for (std::size_t i = 0; i < kCount; i += 4) {
      for (std::size_t half = 0; half < 2; ++half) {
        const Vector& a = pairs[i + half];
        const Vector& b = pairs[i + half + 2];
        fours[i + 2 * half] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
        fours[i + 2 * half + 1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      lines[i].values_ = __builtin_shufflevector(fours[i], fours[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
      lines[i + 4].values_ =
          __builtin_shufflevector(fours[i], fours[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
  }

 private:
  using Vector = float __attribute__((vector_size(kCount * sizeof(float))));
  MEMS_STICTION_INLINE explicit FloatPacket(const Vector& values) : values_(values) {}

  Vector values_;
};

}  // namespace mems_stiction
