#pragma once

/// @file
/// What sums over patches and cells need of four numbers at once, where std::pow would be the most
/// of their time.

#include <cmath>
#include <cstdint>
#include <cstring>

#include "numeric/packet.hpp"

namespace mems_stiction {

/// Whether a comparison holds in any element.
MEMS_STICTION_INLINE bool isAnywhere(const PacketMask& mask) { return mask.count() > 0; }
MEMS_STICTION_INLINE bool isAnywhere(bool condition) { return condition; }

/// The bits of the numbers, and the numbers of the bits.
MEMS_STICTION_INLINE PacketMask bitsOf(const Packet& packet) {
  double values[Packet::kCount];
  packet.store(values);
  PacketMask::Vector bits;
  std::memcpy(&bits, values, sizeof bits);
  return PacketMask(bits);
}
MEMS_STICTION_INLINE Packet elementsOf(const PacketMask& mask) {
  double values[Packet::kCount];
  std::memcpy(values, &mask.bits(), sizeof values);
  return Packet::load(values);
}

/// The greater of two numbers, in each element.
template <typename Real>
MEMS_STICTION_INLINE Real greater(const Real& a, const Real& b) {
  return select(a > b, a, b);
}

MEMS_STICTION_INLINE Packet squareRoot(const Packet& x) {
  double values[Packet::kCount];
  x.store(values);
  for (double& value : values) value = std::sqrt(value);
  return Packet::load(values);
}

MEMS_STICTION_INLINE double squareRoot(double x) { return std::sqrt(x); }

/// 2^(exponent log2 x) with a relative error below 1e-8 for x in [1e-300, 1e300] and results in
/// [1e-300, 1e300].
MEMS_STICTION_INLINE Packet power(const Packet& x, const Packet& exponent) {
  constexpr std::int64_t kMantissa = (std::int64_t{1} << 52) - 1;
  constexpr std::int64_t kBias = 1023;
  constexpr double kTwoTo52 = 4503599627370496.0;
  const PacketMask bits = bitsOf(x);
  // x = 2^whole part, part in [sqrt(1/2), sqrt(2)); an integer behind the exponent of 2^52 is a
  // number's digits
  Packet whole = elementsOf(PacketMask(bits.bits() >> 52) | bitsOf(kTwoTo52)) - (kTwoTo52 + kBias);
  Packet part = elementsOf(PacketMask(bits.bits() & kMantissa) | bitsOf(1.0));
  const PacketMask is_large = part > 1.4142135623730951;
  whole += oneWhere(is_large);
  part = select(is_large, 0.5 * part, part);
  // ln part = 2 artanh t
  const Packet t = (part - 1.0) / (part + 1.0);
  const Packet q = t * t;
  const Packet series =
      1.0 +
      q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0 + q * (1.0 / 11.0)))));
  const Packet log2 = whole + 2.8853900817779268 * t * series;
  // 2^y = 2^nearest e^rest
  const Packet y = exponent * log2;
  const Packet shifted = y + 1.5 * kTwoTo52;
  const Packet rest = 0.6931471805599453 * (y - (shifted - 1.5 * kTwoTo52));
  const Packet exponential =
      1.0 +
      rest *
          (1.0 + rest * (1.0 / 2 +
                         rest * (1.0 / 6 +
                                 rest * (1.0 / 24 +
                                         rest * (1.0 / 120 +
                                                 rest * (1.0 / 720 +
                                                         rest * (1.0 / 5040 + rest / 40320.0)))))));
  return exponential * elementsOf(PacketMask((bitsOf(shifted).bits() + kBias) << 52));
}

MEMS_STICTION_INLINE Packet power(const Packet& x, double exponent) {
  return power(x, Packet(exponent));
}
MEMS_STICTION_INLINE double power(double x, double exponent) { return std::pow(x, exponent); }

}  // namespace mems_stiction
