#include "row_pairs.hpp"

#include <cstdint>
#include <cstring>

#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace row_pairs {
namespace {

constexpr std::size_t kVectorBytes = 32;

/// A few complex numbers side by side, and how to turn them about.
template <typename Scalar>
struct Complexes;

template <>
struct Complexes<float> {
  using Packet = float __attribute__((vector_size(kVectorBytes)));
  using Order = std::int32_t __attribute__((vector_size(kVectorBytes)));
  static constexpr std::size_t kCount = 4;
  static constexpr Order kReversed = {6, 7, 4, 5, 2, 3, 0, 1};
  static constexpr Order kSwapped = {1, 0, 3, 2, 5, 4, 7, 6};
  static constexpr Packet kConjugate = {1, -1, 1, -1, 1, -1, 1, -1};
};

template <>
struct Complexes<double> {
  using Packet = double __attribute__((vector_size(kVectorBytes)));
  using Order = std::int64_t __attribute__((vector_size(kVectorBytes)));
  static constexpr std::size_t kCount = 2;
  static constexpr Order kReversed = {2, 3, 0, 1};
  static constexpr Order kSwapped = {1, 0, 3, 2};
  static constexpr Packet kConjugate = {1, -1, 1, -1};
};

template <typename Packet, typename Order>
MEMS_STICTION_INLINE void reorder(const Order& order, Packet& packet) {
#if defined(__clang__)
  Packet moved;
  for (std::size_t i = 0; i < kVectorBytes / sizeof(packet[0]); ++i) moved[i] = packet[order[i]];
  packet = moved;
#else
  packet = __builtin_shuffle(packet, order);
#endif
}

template <typename Scalar>
MEMS_STICTION_INLINE void joinRows(std::size_t count, const Scalar* first, const Scalar* second,
                                   Scalar* complex) {
  for (std::size_t i = 0; i < count; ++i) {
    complex[2 * i] = first[i];
    complex[2 * i + 1] = second[i];
  }
}

template <typename Scalar>
MEMS_STICTION_INLINE void splitRows(std::size_t count, const Scalar* complex, Scalar* first,
                                    Scalar* second) {
  for (std::size_t i = 0; i < count; ++i) {
    first[i] = complex[2 * i];
    second[i] = complex[2 * i + 1];
  }
}

/// One wave number k and its opposite: 2 A = Z(k) + Z*(-k), 2 B = -i (Z(k) - Z*(-k)).
template <typename Scalar>
MEMS_STICTION_INLINE void splitOne(const Scalar* at, const Scalar* opposite, Scalar* first,
                                   Scalar* second) {
  first[0] = at[0] + opposite[0];
  first[1] = at[1] - opposite[1];
  second[0] = at[1] + opposite[1];
  second[1] = opposite[0] - at[0];
}

template <typename Scalar>
MEMS_STICTION_INLINE void splitBoth(std::size_t count, const Scalar* joined, Scalar* first,
                                    Scalar* second) {
  using Vector = Complexes<Scalar>;
  constexpr std::size_t kCount = Vector::kCount;
  splitOne(joined, joined, first, second);
  const std::size_t last = count / 2;
  std::size_t k = 1;
  for (; k + kCount <= last + 1; k += kCount) {
    typename Vector::Packet at, opposite;
    std::memcpy(&at, joined + 2 * k, sizeof at);
    std::memcpy(&opposite, joined + 2 * (count - k - kCount + 1), sizeof opposite);
    reorder(Vector::kReversed, opposite);
    opposite *= Vector::kConjugate;
    const typename Vector::Packet sum = at + opposite;
    typename Vector::Packet difference = at - opposite;
    reorder(Vector::kSwapped, difference);
    difference *= Vector::kConjugate;
    std::memcpy(first + 2 * k, &sum, sizeof sum);
    std::memcpy(second + 2 * k, &difference, sizeof difference);
  }
  for (; k <= last; ++k)
    splitOne(joined + 2 * k, joined + 2 * (count - k), first + 2 * k, second + 2 * k);
}

/// Z(k) = A + i B; Z(-k) = A* + i B*.
template <typename Scalar>
MEMS_STICTION_INLINE void joinOne(const Scalar* first, const Scalar* second, Scalar* at,
                                  Scalar* opposite) {
  opposite[0] = first[0] + second[1];
  opposite[1] = second[0] - first[1];
  at[0] = first[0] - second[1];
  at[1] = first[1] + second[0];
}

template <typename Scalar>
MEMS_STICTION_INLINE void joinBoth(std::size_t count, const Scalar* first, const Scalar* second,
                                   Scalar* joined) {
  using Vector = Complexes<Scalar>;
  constexpr std::size_t kCount = Vector::kCount;
  Scalar unused[2];
  joinOne(first, second, joined, unused);
  const std::size_t last = (count - 1) / 2;  // with an opposite of its own
  std::size_t k = 1;
  for (; k + kCount <= last + 1; k += kCount) {
    typename Vector::Packet a, b;
    std::memcpy(&a, first + 2 * k, sizeof a);
    std::memcpy(&b, second + 2 * k, sizeof b);
    reorder(Vector::kSwapped, b);
    const typename Vector::Packet turned = b * Vector::kConjugate;  // (Im B, -Re B)
    const typename Vector::Packet at = a - turned;
    typename Vector::Packet opposite = (a + turned) * Vector::kConjugate;
    reorder(Vector::kReversed, opposite);
    std::memcpy(joined + 2 * k, &at, sizeof at);
    std::memcpy(joined + 2 * (count - k - kCount + 1), &opposite, sizeof opposite);
  }
  for (; k <= last; ++k)
    joinOne(first + 2 * k, second + 2 * k, joined + 2 * k, joined + 2 * (count - k));
  if (count % 2 == 0) joinOne(first + count, second + count, joined + count, unused);
}

}  // namespace

MEMS_STICTION_VECTORIZED void join(std::size_t count, const float* first, const float* second,
                                   float* complex) {
  joinRows(count, first, second, complex);
}
MEMS_STICTION_VECTORIZED void join(std::size_t count, const double* first, const double* second,
                                   double* complex) {
  joinRows(count, first, second, complex);
}
MEMS_STICTION_VECTORIZED void split(std::size_t count, const float* complex, float* first,
                                    float* second) {
  splitRows(count, complex, first, second);
}
MEMS_STICTION_VECTORIZED void split(std::size_t count, const double* complex, double* first,
                                    double* second) {
  splitRows(count, complex, first, second);
}
MEMS_STICTION_VECTORIZED void splitSpectrum(std::size_t count, const float* joined, float* first,
                                            float* second) {
  splitBoth(count, joined, first, second);
}
MEMS_STICTION_VECTORIZED void splitSpectrum(std::size_t count, const double* joined, double* first,
                                            double* second) {
  splitBoth(count, joined, first, second);
}
MEMS_STICTION_VECTORIZED void joinSpectra(std::size_t count, const float* first,
                                          const float* second, float* joined) {
  joinBoth(count, first, second, joined);
}
MEMS_STICTION_VECTORIZED void joinSpectra(std::size_t count, const double* first,
                                          const double* second, double* joined) {
  joinBoth(count, first, second, joined);
}

}  // namespace row_pairs
}  // namespace mems_stiction
