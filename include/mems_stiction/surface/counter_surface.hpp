#pragma once

/// The surface that the scan is brought into contact with.

#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

enum class CounterSurfaceType {
  kFlat,   ///< a plane
  kTopic,  ///< a measured height map that arrives beside the scans
};

/// Which way the heights of a measured counter-surface point.
enum class CounterSurfaceFacing {
  kDown,  ///< as mounted: z and columns are those of the scan's frame
  kUp,    ///< as measured, asperities up: turned over about its y axis (z negated, columns mirrored)
};

struct CounterSurfaceOptions {
  CounterSurfaceType type = CounterSurfaceType::kFlat;
  CounterSurfaceFacing facing = CounterSurfaceFacing::kDown;

  void describe(OptionVisitor& visitor);
};

/// The counter-surface in the scan's frame. Turning over twice gives back the surface.
HeightMap mountedCounterSurface(const HeightMap& measured, CounterSurfaceFacing facing);

}  // namespace mems_stiction
