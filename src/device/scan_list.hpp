#pragma once

/// @file
/// What the scans of a surface are as a list: their maps, their finest pixels, the ones that have
/// those.

#include <algorithm>
#include <vector>

#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

inline double areaOf(const HeightMap& surface) {
  return surface.rows() * surface.cols() * surface.cellArea();
}  // [m^2]
inline double longerPitch(const HeightMap& surface) {
  return std::max(surface.pitchX(), surface.pitchY());
}

/// An order of scans by what they show, so that none hangs on that in which they were given: finer
/// pixels first, then larger areas, then by the heights. Of the same heights neither comes before.
bool comesBefore(const HeightMap& one, const HeightMap& other);

/// Without their names; the pixels are shared.
std::vector<HeightMap> mapsOf(const std::vector<NamedScan>& scans);
/// The shortest of their longer pitches [m]; infinity for none.
double finestPitch(const std::vector<HeightMap>& scans);
/// Whether a scan's pixels are short enough beside the finest [m] to show the same summits.
bool showsSummits(const HeightMap& scan, double finest);
/// The finest, which alone may stand for contacts.
std::vector<HeightMap> fineMapsOf(const std::vector<NamedScan>& scans);

}  // namespace mems_stiction
