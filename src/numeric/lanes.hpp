#pragma once

/// @file
/// Four numbers that a pass over the frame takes at once, in the instructions that the processor has. A formula reads as
/// for one number, and may be a template of both:
///
///     template <typename Real>
///     MEMS_STICTION_INLINE Real cutOff(const Real& gap, double limit) { return select(gap > limit, gap, Real(limit)); }

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "numeric/vectorized.hpp"

namespace mems_stiction {

/// In which of the lanes a comparison is true.
class LaneMask {
 public:
  using Vector = std::int64_t __attribute__((vector_size(32)));  ///< all bits set where it is true, none elsewhere

  MEMS_STICTION_INLINE explicit LaneMask(const Vector& bits) : bits_(bits) {}
  // Written out, here and below: how else the class is handed over depends on the instructions a file is compiled for.
  MEMS_STICTION_INLINE LaneMask(const LaneMask& other) : bits_(other.bits_) {}  // NOLINT(modernize-use-equals-default)
  LaneMask& operator=(const LaneMask& other) = default;

  MEMS_STICTION_INLINE const Vector& bits() const { return bits_; }
  /// Where one of them is true, not both.
  friend MEMS_STICTION_INLINE LaneMask operator^(const LaneMask& a, const LaneMask& b) {
    return LaneMask(a.bits_ ^ b.bits_);
  }
  /// Where either is true.
  friend MEMS_STICTION_INLINE LaneMask operator|(const LaneMask& a, const LaneMask& b) {
    return LaneMask(a.bits_ | b.bits_);
  }

  /// In how many lanes it is true.
  MEMS_STICTION_INLINE int count() const { return -static_cast<int>(bits_[0] + bits_[1] + bits_[2] + bits_[3]); }

 private:
  Vector bits_;
};

/// Four doubles. Every operator is that of the four numbers, to the bit.
class Lanes {
 public:
  static constexpr std::size_t kCount = 4;

  /// 0 in all lanes.
  MEMS_STICTION_INLINE Lanes() : values_{} {}
  /// The same number in all lanes.
  MEMS_STICTION_INLINE Lanes(double value) : values_{value, value, value, value} {}  // NOLINT: as double from int
  MEMS_STICTION_INLINE Lanes(double a, double b, double c, double d) : values_{a, b, c, d} {}
  MEMS_STICTION_INLINE Lanes(const Lanes& other) : values_(other.values_) {}  // NOLINT(modernize-use-equals-default)
  Lanes& operator=(const Lanes& other) = default;

  /// From memory.
  MEMS_STICTION_INLINE static Lanes load(const double* values) {
    Vector loaded;
    std::memcpy(&loaded, values, sizeof loaded);
    return Lanes(loaded);
  }
  MEMS_STICTION_INLINE static Lanes load(const float* values) {
    float __attribute__((vector_size(kCount * sizeof(float)))) loaded;
    std::memcpy(&loaded, values, sizeof loaded);
    return Lanes(__builtin_convertvector(loaded, Vector));
  }
  /// The first `count` lanes from memory, the others `rest`.
  template <typename Scalar>
  MEMS_STICTION_INLINE static Lanes loadFirst(const Scalar* values, std::size_t count, double rest) {
    Lanes lanes(rest);
    for (std::size_t i = 0; i < count; ++i) lanes.values_[i] = values[i];
    return lanes;
  }

  /// To memory.
  MEMS_STICTION_INLINE void store(double* values) const { std::memcpy(values, &values_, sizeof values_); }
  /// The first `count` lanes to memory.
  MEMS_STICTION_INLINE void storeFirst(std::size_t count, double* values) const {
    for (std::size_t i = 0; i < count; ++i) values[i] = values_[i];
  }

  MEMS_STICTION_INLINE double operator[](std::size_t lane) const { return values_[lane]; }
  MEMS_STICTION_INLINE double sum() const { return values_[0] + values_[1] + values_[2] + values_[3]; }
  MEMS_STICTION_INLINE double smallest() const { return std::min({values_[0], values_[1], values_[2], values_[3]}); }
  MEMS_STICTION_INLINE double largest() const { return std::max({values_[0], values_[1], values_[2], values_[3]}); }

  MEMS_STICTION_INLINE Lanes& operator+=(const Lanes& other) {
    values_ += other.values_;
    return *this;
  }
  friend MEMS_STICTION_INLINE Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.values_ + b.values_); }
  friend MEMS_STICTION_INLINE Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.values_ - b.values_); }
  friend MEMS_STICTION_INLINE Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.values_ * b.values_); }
  friend MEMS_STICTION_INLINE Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.values_ / b.values_); }
  friend MEMS_STICTION_INLINE LaneMask operator<(const Lanes& a, const Lanes& b) {
    return LaneMask(a.values_ < b.values_);
  }
  friend MEMS_STICTION_INLINE LaneMask operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend MEMS_STICTION_INLINE LaneMask operator==(const Lanes& a, const Lanes& b) {
    return LaneMask(a.values_ == b.values_);
  }

  /// In each lane what `a` has where the mask is set, else what `b` has.
  friend MEMS_STICTION_INLINE Lanes select(const LaneMask& mask, const Lanes& a, const Lanes& b) {
    return Lanes(mask.bits() ? a.values_ : b.values_);
  }

 private:
  using Vector = double __attribute__((vector_size(kCount * sizeof(double))));
  MEMS_STICTION_INLINE explicit Lanes(const Vector& values) : values_(values) {}

  Vector values_;
};

/// Where a number is one, not NaN.
MEMS_STICTION_INLINE LaneMask isNumber(const Lanes& lanes) { return lanes == lanes; }
/// 1 where the mask is set, else 0: for counting.
MEMS_STICTION_INLINE Lanes oneWhere(const LaneMask& mask) { return select(mask, Lanes(1.0), Lanes(0.0)); }

/// The same for one number.
MEMS_STICTION_INLINE double select(bool condition, double a, double b) { return condition ? a : b; }

}  // namespace mems_stiction
