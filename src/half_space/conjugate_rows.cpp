#include "conjugate_rows.hpp"

namespace mems_stiction {
namespace conjugate_rows {
namespace {

constexpr std::size_t kElements = 8;
using Packet = float __attribute__((vector_size(kElements * sizeof(float))));
using Mask = int __attribute__((vector_size(kElements * sizeof(int))));

/// Eight values from `from`, or as many as there are, the others `filler`.
MEMS_STICTION_INLINE void take(const float* from, std::size_t available, Packet& packet,
                               float filler = 0.0F) {
  if (available >= kElements) {
    std::memcpy(&packet, from, sizeof packet);
  } else {
    packet = Packet{} + filler;
    std::memcpy(&packet, from, available * sizeof(float));
  }
}

MEMS_STICTION_INLINE void put(const Packet& packet, std::size_t available, float* to) {
  std::memcpy(to, &packet, available >= kElements ? sizeof packet : available * sizeof(float));
}

MEMS_STICTION_INLINE double sumOf(const Packet& packet) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kElements; ++i) sum += static_cast<double>(packet[i]);
  return sum;
}

MEMS_STICTION_INLINE void raiseTo(const Packet& values, Packet& largest) {
  const Packet magnitude = values < 0.0F ? -values : values;
  largest = magnitude > largest ? magnitude : largest;
}

MEMS_STICTION_INLINE double largestOf(const Packet& packet) {
  float largest = packet[0];
  for (std::size_t i = 1; i < kElements; ++i) largest = packet[i] > largest ? packet[i] : largest;
  return static_cast<double>(largest);
}

}  // namespace

MEMS_STICTION_VECTORIZED Sums turn(std::size_t count, float ratio, float shift, float mean,
                                   const float* smoothed, const float* residual, const float* slope,
                                   float* search, float* search_traction) {
  Packet products{};
  Packet sums{};
  Packet z, r, d, p, kp;
  for (std::size_t i = 0; i < count; i += kElements) {
    const std::size_t rest = count - i;
    take(smoothed + i, rest, z);
    take(residual + i, rest, r, mean);  // packets beyond the row add nothing to the sums
    take(slope + i, rest, d);
    take(search + i, rest, p);
    take(search_traction + i, rest, kp);
    p = z + ratio * p;
    kp = ((r - mean) - shift * z) + ratio * kp;
    const Packet q = kp + d * p;
    products += p * q;
    sums += q;
    put(p, rest, search + i);
    put(kp, rest, search_traction + i);
  }
  return {sumOf(products), sumOf(sums), 0.0};
}

MEMS_STICTION_VECTORIZED Sums weigh(std::size_t count, float yielding, float mean,
                                    const float* residual, const float* slope, float* smoothed) {
  Packet r, d;
  for (std::size_t i = 0; i < count; i += kElements) {
    const std::size_t rest = count - i;
    take(residual + i, rest, r);
    take(slope + i, rest, d);
    put(yielding / (yielding + (d > 0.0F ? d : 0.0F)) * (r - mean), rest, smoothed + i);
  }
  return {};
}

MEMS_STICTION_VECTORIZED Sums combine(std::size_t count, float yielding, float rough, float mean,
                                      const float* residual, const float* slope, float* smoothed) {
  Packet products{};
  Packet sums{};
  Packet z, r, d;
  for (std::size_t i = 0; i < count; i += kElements) {
    const std::size_t rest = count - i;
    take(smoothed + i, rest, z);
    take(residual + i, rest, r, mean);  // packets beyond the row add nothing to the sums
    take(slope + i, rest, d);
    const Packet contact_slope = d > 0.0F ? d : 0.0F;
    z = yielding / (yielding + contact_slope) * z + (r - mean) / (rough + contact_slope);
    products += z * (r - mean);
    sums += z;
    put(z, rest, smoothed + i);
  }
  return {sumOf(products), sumOf(sums), 0.0};
}

MEMS_STICTION_VECTORIZED Sums follow(std::size_t count, float ratio, float smoothed_mean,
                                     const float* smoothed, float* search) {
  Packet z, p;
  for (std::size_t i = 0; i < count; i += kElements) {
    const std::size_t rest = count - i;
    take(smoothed + i, rest, z);
    take(search + i, rest, p);
    put((z - smoothed_mean) + ratio * p, rest, search + i);
  }
  return {};
}

MEMS_STICTION_VECTORIZED Sums respond(std::size_t count, const float* slope, const float* search,
                                      const float* search_traction) {
  Packet products{};
  Packet sums{};
  Packet d, p, kp;
  for (std::size_t i = 0; i < count; i += kElements) {
    const std::size_t rest = count - i;
    take(slope + i, rest, d);
    take(search + i, rest, p);
    take(search_traction + i, rest, kp);
    const Packet q = kp + d * p;
    products += p * q;
    sums += q;
  }
  return {sumOf(products), sumOf(sums), 0.0};
}

MEMS_STICTION_VECTORIZED Sums advance(std::size_t count, float length, const float* slope,
                                      const float* search, const float* search_traction,
                                      float* step, float* /*first_residual*/, float* residual) {
  Packet largest{};
  Packet d, p, kp, s, r;
  for (std::size_t i = 0; i < count; i += kElements) {
    const std::size_t rest = count - i;
    take(slope + i, rest, d);
    take(search + i, rest, p);
    take(search_traction + i, rest, kp);
    take(step + i, rest, s);
    take(residual + i, rest, r);
    s += length * p;
    r -= length * (kp + d * p);
    raiseTo(s, largest);
    put(s, rest, step + i);
    put(r, rest, residual + i);
  }
  return {0.0, 0.0, largestOf(largest)};
}

Sums begin(std::size_t count, float length, const float* slope, const float* search,
           const float* search_traction, float* step, float* first_residual, float* residual) {
  std::memcpy(first_residual, residual, count * sizeof(float));
  std::memset(step, 0, count * sizeof(float));
  return advance(count, length, slope, search, search_traction, step, first_residual, residual);
}

MEMS_STICTION_VECTORIZED Sums finish(std::size_t count, const float* slope, const float* step,
                                     const float* residual, float* first_residual) {
  Packet d, s, r, first;
  for (std::size_t i = 0; i < count; i += kElements) {
    const std::size_t rest = count - i;
    take(slope + i, rest, d);
    take(step + i, rest, s);
    take(residual + i, rest, r);
    take(first_residual + i, rest, first);
    put((first - r) - d * s, rest, first_residual + i);
  }
  return {};
}

MEMS_STICTION_VECTORIZED Sums largest(std::size_t count, const float* values) {
  Packet most{};
  Packet packet;
  for (std::size_t i = 0; i < count; i += kElements) {
    take(values + i, count - i, packet);
    raiseTo(packet, most);
  }
  return {0.0, 0.0, largestOf(most)};
}

}  // namespace conjugate_rows
}  // namespace mems_stiction
