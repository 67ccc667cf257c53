#pragma once

/// One sphere on a flat: how it lies on the grid, and the bodies and loads that closed forms are
/// known for.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/options.hpp"

namespace mems_stiction {

/// How a frame lies around a sphere.
struct SphereGrid {
  const char* name;
  double rows_per_radius;  ///< the frame's height in contact radii
  double cols_per_radius;
  int odd;                  ///< 1 makes both sides odd, so that the apex is a pixel
  double pitch_ratio;       ///< dy/dx
  double shift_x, shift_y;  ///< of the apex [pixels]
};

/// A sphere of this radius, sampled so that the contact radius spans so many columns.
HeightMap sphereOn(const SphereGrid& grid, double radius, double contact_radius, double pixels);

/// Polysilicon on polysilicon that nothing attracts across the gap: contact mechanics alone.
Options contactOnly(double mechanical_load, double work_of_adhesion);

}  // namespace mems_stiction
