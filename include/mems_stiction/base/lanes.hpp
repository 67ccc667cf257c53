#pragma once

/// @file
/// Four doubles that are added, compared and chosen side by side, in the instructions that the processor has.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace mems_stiction {

constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
using LanePair = double __attribute__((vector_size(2 * sizeof(double))));
/// What comparing two Lanes gives: all bits set where it holds, none elsewhere.
using LaneMask = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

/// By reference: how lanes are returned would depend on the instructions that a file is compiled for.
inline void load(const double* values, Lanes& lanes) { std::memcpy(&lanes, values, sizeof lanes); }

inline double sumOf(const Lanes& lanes) { return lanes[0] + lanes[1] + lanes[2] + lanes[3]; }
inline double smallestOf(const Lanes& lanes) { return std::min({lanes[0], lanes[1], lanes[2], lanes[3]}); }
inline double largestOf(const Lanes& lanes) { return std::max({lanes[0], lanes[1], lanes[2], lanes[3]}); }

}  // namespace mems_stiction
