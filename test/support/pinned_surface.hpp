#pragma once

/// A surface held apart from its counter-surface: loads across a gap without a contact in between.

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// The surface with two more rows below: invalid pixels, and one that stands `gap` above the level
/// z = 0. It touches first; every other pixel is then apart by gap - z.
HeightMap pinnedSurface(const HeightMap& surface, double gap);

}  // namespace mems_stiction
