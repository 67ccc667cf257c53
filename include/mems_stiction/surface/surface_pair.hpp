#pragma once

/// @file
/// The two surfaces that meet.
///
///     const SurfacePair on_a_plane(scan);
///     const SurfacePair pair(scan, counter_surface);

#include <utility>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Two surfaces in one frame: z of both points from lower to upper. Without an upper surface there
/// is a level plane at z = 0 in its place. An empty `upper` is the one way to say so.
struct SurfacePair {
  SurfacePair() = default;
  SurfacePair(
      HeightMap lower_in,
      HeightMap upper_in = {})  // NOLINT(google-explicit-constructor): one surface is a pair
      : lower(std::move(lower_in)), upper(std::move(upper_in)) {}

  bool upperIsPlane() const { return upper.empty(); }

  HeightMap lower;
  HeightMap upper;  ///< same rows, cols and pitch; empty for a level plane
};

}  // namespace mems_stiction
