#pragma once

/// @file
/// One surface of the device's size, as the scans may have been parts of it.

#include <cstdint>

#include "mems_stiction/height_map/height_map.hpp"
#include "roughness/merged_spectrum.hpp"

namespace mems_stiction {

/// - @p spectrum with its uncertainty: a realisation of that is drawn as well
HeightMap madeSurface(const MergedSpectrum& spectrum, int rows, int cols, double pitch, std::uint64_t seed);

}  // namespace mems_stiction
