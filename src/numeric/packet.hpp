#pragma once

/// @file
/// Four numbers that a pass over the frame takes at once, in the instructions that the processor
/// has. A formula reads as for one number, and may be a template of both:
///
///     template <typename Real>
///     MEMS_STICTION_INLINE Real cutOff(const Real& gap, double limit) {
///       return select(gap > limit, gap, Real(limit));
///     }

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "numeric/vectorized.hpp"

namespace mems_stiction {

/// In which of the elements a comparison is true.
class PacketMask {
 public:
  using Vector = std::int64_t
      __attribute__((vector_size(32)));  ///< all bits set where it is true, none elsewhere

  MEMS_STICTION_INLINE explicit PacketMask(const Vector& bits) : bits_(bits) {}
  // Written out, here and below: how else the class is handed over depends on the instructions a
  // file is compiled for.
  // NOLINTNEXTLINE(modernize-use-equals-default)
  MEMS_STICTION_INLINE PacketMask(const PacketMask& other) : bits_(other.bits_) {}
  PacketMask& operator=(const PacketMask& other) = default;

  MEMS_STICTION_INLINE const Vector& bits() const { return bits_; }
  /// Where one of them is true, not both.
  friend MEMS_STICTION_INLINE PacketMask operator^(const PacketMask& a, const PacketMask& b) {
    return PacketMask(a.bits_ ^ b.bits_);
  }
  /// Where either is true.
  friend MEMS_STICTION_INLINE PacketMask operator|(const PacketMask& a, const PacketMask& b) {
    return PacketMask(a.bits_ | b.bits_);
  }

  /// In how many elements it is true.
  MEMS_STICTION_INLINE int count() const {
    return -static_cast<int>(bits_[0] + bits_[1] + bits_[2] + bits_[3]);
  }

 private:
  Vector bits_;
};

/// Four doubles. Every operator is that of the four numbers, to the bit.
class Packet {
 public:
  static constexpr std::size_t kCount = 4;

  /// 0 in all elements.
  MEMS_STICTION_INLINE Packet() : values_{} {}
  /// The same number in all elements.
  MEMS_STICTION_INLINE Packet(double value)
      : values_{value, value, value, value} {}  // NOLINT: as double from int
  MEMS_STICTION_INLINE Packet(double a, double b, double c, double d) : values_{a, b, c, d} {}
  // NOLINTNEXTLINE(modernize-use-equals-default)
  MEMS_STICTION_INLINE Packet(const Packet& other) : values_(other.values_) {}
  Packet& operator=(const Packet& other) = default;

  /// From memory.
  MEMS_STICTION_INLINE static Packet load(const double* values) {
    Vector loaded;
    std::memcpy(&loaded, values, sizeof loaded);
    return Packet(loaded);
  }
  MEMS_STICTION_INLINE static Packet load(const float* values) {
    float __attribute__((vector_size(kCount * sizeof(float)))) loaded;
    std::memcpy(&loaded, values, sizeof loaded);
    return Packet(__builtin_convertvector(loaded, Vector));
  }
  /// The first `count` elements from memory, the others `rest`.
  template <typename Scalar>
  MEMS_STICTION_INLINE static Packet loadFirst(const Scalar* values, std::size_t count,
                                               double rest) {
    Packet packet(rest);
    for (std::size_t i = 0; i < count; ++i) packet.values_[i] = values[i];
    return packet;
  }

  /// To memory.
  MEMS_STICTION_INLINE void store(double* values) const {
    std::memcpy(values, &values_, sizeof values_);
  }
  /// The first `count` elements to memory.
  MEMS_STICTION_INLINE void storeFirst(std::size_t count, double* values) const {
    for (std::size_t i = 0; i < count; ++i) values[i] = values_[i];
  }

  MEMS_STICTION_INLINE double operator[](std::size_t element) const { return values_[element]; }
  MEMS_STICTION_INLINE double sum() const {
    return values_[0] + values_[1] + values_[2] + values_[3];
  }
  MEMS_STICTION_INLINE double smallest() const {
    return std::min({values_[0], values_[1], values_[2], values_[3]});
  }
  MEMS_STICTION_INLINE double largest() const {
    return std::max({values_[0], values_[1], values_[2], values_[3]});
  }

  MEMS_STICTION_INLINE Packet& operator+=(const Packet& other) {
    values_ += other.values_;
    return *this;
  }
  friend MEMS_STICTION_INLINE Packet operator+(const Packet& a, const Packet& b) {
    return Packet(a.values_ + b.values_);
  }
  friend MEMS_STICTION_INLINE Packet operator-(const Packet& a, const Packet& b) {
    return Packet(a.values_ - b.values_);
  }
  friend MEMS_STICTION_INLINE Packet operator*(const Packet& a, const Packet& b) {
    return Packet(a.values_ * b.values_);
  }
  friend MEMS_STICTION_INLINE Packet operator/(const Packet& a, const Packet& b) {
    return Packet(a.values_ / b.values_);
  }
  friend MEMS_STICTION_INLINE PacketMask operator<(const Packet& a, const Packet& b) {
    return PacketMask(a.values_ < b.values_);
  }
  friend MEMS_STICTION_INLINE PacketMask operator>(const Packet& a, const Packet& b) {
    return b < a;
  }
  friend MEMS_STICTION_INLINE PacketMask operator==(const Packet& a, const Packet& b) {
    return PacketMask(a.values_ == b.values_);
  }

  /// In each element what `a` has where the mask is set, else what `b` has.
  friend MEMS_STICTION_INLINE Packet select(const PacketMask& mask, const Packet& a,
                                            const Packet& b) {
    return Packet(mask.bits() ? a.values_ : b.values_);
  }

 private:
  using Vector = double __attribute__((vector_size(kCount * sizeof(double))));
  MEMS_STICTION_INLINE explicit Packet(const Vector& values) : values_(values) {}

  Vector values_;
};

/// Where a number is one, not NaN.
MEMS_STICTION_INLINE PacketMask isNumber(const Packet& packet) { return packet == packet; }
/// 1 where the mask is set, else 0: for counting.
MEMS_STICTION_INLINE Packet oneWhere(const PacketMask& mask) {
  return select(mask, Packet(1.0), Packet(0.0));
}

/// The same for one number.
MEMS_STICTION_INLINE double select(bool condition, double a, double b) { return condition ? a : b; }

}  // namespace mems_stiction
