#pragma once

/// @file
/// Four doubles that are added, compared and chosen side by side, in the instructions that the processor has.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {

constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
/// What comparing two Lanes gives: all bits set where it holds, none elsewhere.
using LaneMask = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));
using IntegerLanes = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

/// By reference: how lanes are returned would depend on the instructions that a file is compiled for.
inline void load(const double* values, Lanes& lanes) { std::memcpy(&lanes, values, sizeof lanes); }
/// value(i) for each lane i.
template <typename Value>
MEMS_STICTION_INLINE void fill(const Value& value, Lanes& lanes) {
  lanes = Lanes{static_cast<double>(value(0)), static_cast<double>(value(1)), static_cast<double>(value(2)),
                static_cast<double>(value(3))};
}

MEMS_STICTION_INLINE void takeRoot(const Lanes& lanes, Lanes& roots) {
  fill([&](int i) { return std::sqrt(lanes[i]); }, roots);
}

/// Four of the eight values of a (0 to 3) and b (4 to 7).
template <int first, int second, int third, int fourth>
MEMS_STICTION_INLINE void pick(const Lanes& a, const Lanes& b, Lanes& picked) {
#if defined(__clang__)
  picked = __builtin_shufflevector(a, b, first, second, third, fourth);
#else  // the name that GCC before 12 knows
  picked = __builtin_shuffle(a, b, LaneMask{first, second, third, fourth});
#endif
}

/// Rows become columns: a[i], b[i], c[i], d[i] become the i-th of them.
inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  Lanes even_ab, odd_ab, even_cd, odd_cd;
  pick<0, 4, 2, 6>(a, b, even_ab);
  pick<1, 5, 3, 7>(a, b, odd_ab);
  pick<0, 4, 2, 6>(c, d, even_cd);
  pick<1, 5, 3, 7>(c, d, odd_cd);
  pick<0, 1, 4, 5>(even_ab, even_cd, a);
  pick<0, 1, 4, 5>(odd_ab, odd_cd, b);
  pick<2, 3, 6, 7>(even_ab, even_cd, c);
  pick<2, 3, 6, 7>(odd_ab, odd_cd, d);
}

inline double sumOf(const Lanes& lanes) { return lanes[0] + lanes[1] + lanes[2] + lanes[3]; }
inline double smallestOf(const Lanes& lanes) { return std::min({lanes[0], lanes[1], lanes[2], lanes[3]}); }
inline double largestOf(const Lanes& lanes) { return std::max({lanes[0], lanes[1], lanes[2], lanes[3]}); }

}  // namespace mems_stiction
