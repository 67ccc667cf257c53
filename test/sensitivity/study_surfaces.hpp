#pragma once

/// What the study of sensitivities predicts: several scans each of a smooth, a rough and a self-affine surface, or the
/// quarters of given scan files.

#include <functional>
#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/scan/configuration.hpp"

namespace mems_stiction {
namespace study {

/// One place of a surface, drawn or measured at a fine pitch; the scan of it has pixels of `scan_factor` fine ones.
struct Place {
  HeightMap fine;
  int scan_factor = 1;
};

/// Several places of one surface. They are made one at a time: a fine surface takes tens of megabytes.
struct Surface {
  std::string name;
  std::string description;
  int count = 0;
  std::function<Place(int index)> place;  ///< index in [0, count); the same index gives the same place
};

/// The three generated surfaces.
/// @param scans places of each: seeds 1, 2, ...
/// @param pixels of a side of a scan; the fine surface has twice as many
std::vector<Surface> generatedSurfaces(int scans, int pixels);

/// A scan file as a surface of four places, its quarters, cleaned as the configuration says.
/// @throw FileError, SurfaceError if it cannot be read, or a side has too few pixels.
Surface surfaceOfFile(const std::string& path, const Configuration& configuration);

/// Smooth Gaussian surfaces of rising rms height, one place per seed: where the contact fraction limit decides.
std::vector<Surface> surfacesNearBonding(int scans, int pixels);

}  // namespace study
}  // namespace mems_stiction
