#include "surface/numbered_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <Random123/philox.h>

#include "numeric/constants.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kPacket = 8;
using Doubles = double __attribute__((vector_size(kPacket * sizeof(double))));
using Bits = std::uint64_t __attribute__((vector_size(kPacket * sizeof(std::uint64_t))));
using ShortBits = std::uint32_t __attribute__((vector_size(kPacket * sizeof(std::uint32_t))));

template <typename To, typename From>
MEMS_STICTION_INLINE void copyBits(const From& from, To& to) {
  static_assert(sizeof(To) == sizeof(From), "the same bits");
  std::memcpy(&to, &from, sizeof to);
}

/// Whole numbers below 2^52 as doubles.
MEMS_STICTION_INLINE void toDoubles(const Bits& whole, Doubles& numbers) {
  constexpr std::uint64_t kExponent = 0x4330000000000000U;  // of 2^52
  copyBits(Bits(whole | kExponent), numbers);
  numbers -= 0x1p52;
}

/// -2 log((k + 1/2)/2^32).
MEMS_STICTION_INLINE void squaredRadii(const Bits& k, Doubles& squares) {
  Doubles x;
  toDoubles(k, x);
  x = (x + 0.5) * 0x1p-32;
  // x = 2^e m with m from sqrt(1/2) to sqrt(2); log m = 2 artanh((m - 1)/(m + 1)), whose series
  // ends below 1e-16
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcdU;
  constexpr std::uint64_t kBias = 1023;
  Bits bits;
  copyBits(x, bits);
  const Bits exponent = (bits - kRootHalf + (kBias << 52U)) >> 52U;
  Doubles m;
  copyBits(Bits(bits - ((exponent - kBias) << 52U)), m);
  Doubles e;
  toDoubles(exponent, e);
  e -= static_cast<double>(kBias);
  const Doubles s = (m - 1.0) / (m + 1.0);
  const Doubles z = s * s;
  Doubles sum = z * (1.0 / 19.0) + 1.0 / 17.0;
  for (const double order : {15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0}) sum = sum * z + 1.0 / order;
  constexpr double kLog2 = 0.693147180559945309417;
  squares = e * (-2.0 * kLog2) - 4.0 * (s + s * z * sum);
}

/// cos and sin of 2 pi k/2^32.
MEMS_STICTION_INLINE void unitVectors(const Bits& k, Doubles& cosines, Doubles& sines) {
  // a quarter turn and what is left of it, from -pi/4 to pi/4
  const Bits quarter = (k + (std::uint64_t{1} << 29U)) >> 30U;
  Doubles rest;
  toDoubles(k + (std::uint64_t{1} << 33U) - (quarter << 30U), rest);
  rest = (rest - 0x1p33) * (2.0 * kPi * 0x1p-32);
  const Doubles z = -(rest * rest);
  Doubles sine = z * (1.0 / (16.0 * 17.0)) + 1.0;
  for (const double n : {15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0})
    sine = sine * z * (1.0 / ((n - 1.0) * n)) + 1.0;
  sine = sine * rest;
  Doubles cosine = z * (1.0 / (15.0 * 16.0)) + 1.0;
  for (const double n : {14.0, 12.0, 10.0, 8.0, 6.0, 4.0, 2.0})
    cosine = cosine * z * (1.0 / ((n - 1.0) * n)) + 1.0;

  Bits cosine_bits;
  Bits sine_bits;
  copyBits(cosine, cosine_bits);
  copyBits(sine, sine_bits);
  const Bits swap = -(quarter & 1U);
  const Bits cosine_sign = ((quarter + 1U) & 2U) << 62U;
  const Bits sine_sign = (quarter & 2U) << 62U;
  copyBits(Bits(((cosine_bits & ~swap) | (sine_bits & swap)) ^ cosine_sign), cosines);
  copyBits(Bits(((sine_bits & ~swap) | (cosine_bits & swap)) ^ sine_sign), sines);
}

MEMS_STICTION_INLINE void loadBits(const std::uint32_t* from, Bits& bits) {
  ShortBits loaded;
  std::memcpy(&loaded, from, sizeof loaded);
  bits = __builtin_convertvector(loaded, Bits);
}

/// Two normal numbers, one beside the other, of each pair of a radius and an angle. `count` pairs,
/// a multiple of 8.
MEMS_STICTION_WIDELY_VECTORIZED void boxMuller(const std::uint32_t* radii,
                                               const std::uint32_t* angles, std::size_t count,
                                               float* values) {
  for (std::size_t i = 0; i < count; i += kPacket) {
    Bits k;
    Doubles squares;
    loadBits(radii + i, k);
    squaredRadii(k, squares);
    Doubles cosines;
    Doubles sines;
    loadBits(angles + i, k);
    unitVectors(k, cosines, sines);
    for (std::size_t element = 0; element < kPacket; ++element)
      squares[element] = std::sqrt(squares[element]);
    cosines *= squares;
    sines *= squares;
    for (std::size_t element = 0; element < kPacket; ++element) {
      values[2 * (i + element)] = static_cast<float>(cosines[element]);
      values[2 * (i + element) + 1] = static_cast<float>(sines[element]);
    }
  }
}

}  // namespace

void NumberedNoise::reseed(std::uint64_t seed) {
  seed_ = seed;
  std::fill(known_.begin(), known_.end(), KnownRow());
}

void NumberedNoise::remember(std::int64_t rows, std::int64_t col, std::int64_t cols) {
  known_.assign(static_cast<std::size_t>(rows), {});
  first_col_ = col;
  col_count_ = cols;
  remembered_.resize(known_.size() * static_cast<std::size_t>(cols));
}

void NumberedNoise::fill(std::int64_t row, std::int64_t col, int count, float* values) {
  if (known_.empty() || col < first_col_ || col + count > first_col_ + col_count_) {
    make(row, col, count, values);
    return;
  }
  const auto rows = static_cast<std::int64_t>(known_.size());
  const auto place = static_cast<std::size_t>((row % rows + rows) % rows);
  KnownRow& known = known_[place];
  if (known.row != row || col < known.begin || col > known.end) known = {row, col, col};
  float* const line = &remembered_[place * static_cast<std::size_t>(col_count_)];
  if (known.end < col + count) {
    make(row, known.end, static_cast<int>(col + count - known.end),
         line + (known.end - first_col_));
    known.end = col + count;
  }
  std::copy_n(line + (col - first_col_), count, values);
}

void NumberedNoise::make(std::int64_t row, std::int64_t col, int count, float* values) {
  const auto pairs = static_cast<std::size_t>(count) / 2;
  const std::size_t in_packets = pairs / kPacket * kPacket;
  radii_.resize(in_packets + kPacket);
  angles_.resize(in_packets + kPacket);
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32U)}};
  r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(col >> 2), static_cast<std::uint32_t>(row), layer_, 0}};
  r123::Philox4x32 generator;
  for (std::size_t i = 0; i < pairs; i += 2) {
    const r123::Philox4x32::ctr_type bits = generator(counter, key);
    radii_[i] = bits[0];
    angles_[i] = bits[1];
    radii_[i + 1] = bits[2];
    angles_[i + 1] = bits[3];
    ++counter[0];
  }
  boxMuller(radii_.data(), angles_.data(), in_packets, values);
  if (in_packets == pairs) return;
  float rest[2 * kPacket];
  boxMuller(radii_.data() + in_packets, angles_.data() + in_packets, kPacket, rest);
  std::copy_n(rest, 2 * (pairs - in_packets), values + 2 * in_packets);
}

}  // namespace mems_stiction
