#pragma once

/// @file
/// How does the counter-surface lie over the scan, and what are its heights on the scan's grid?
///
/// Both surfaces have their frame's origin in the middle of their pixels, ((cols - 1)/2 pitch_x,
/// (rows - 1)/2 pitch_y), axes along columns and rows. The pose gives the counter-surface's frame
/// in the scan's:
///
///     (x, y) = R(rotation) (x', y') + (offset_x, offset_y),
///             z(x, y) = z'(x', y') + x tan(tilt_x) + y tan(tilt_y)
///
/// so a positive offset_x moves the counter-surface towards larger columns, a positive rotation
/// turns its +x axis towards the scan's +y axis (larger rows), and a positive tilt_x lifts its side
/// of larger columns. Tilts are applied as a slope along z, which holds for small ones: 1 degree
/// shortens lengths by 0.015 %.
///
/// Heights between pixels by cubic convolution (refine.hpp: a = -1/2); on a pixel they are that
/// pixel's, to the bit. They are point samples, not means: a counter-surface that is finer than the
/// scan keeps its summits' heights, and loses those that fall between the scan's pixels.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/surface/counter_surface_options.hpp"

namespace mems_stiction {

/// What lies beyond the counter-surface's pixels.
enum class Beyond {
  kInvalid,   ///< nothing: such cells are invalid, and touch nothing
  kPeriodic,  ///< the same surface again, for synthetic ones that wrap around
};

/// Pixels of the same number and size.
bool haveSameGrid(const HeightMap& a, const HeightMap& b);

/// The counter-surface on the scan's grid: the scan's rows, cols and pitches, CV_64FC1, metres. A
/// cell is invalid when its nearest pixel of the counter-surface is, or lies beyond it; beside
/// invalid pixels heights are linear between the valid ones.
/// @throw OptionsError if the pose is not finite or out of range.
/// @throw SurfaceError if the surfaces do not overlap in a valid cell.
HeightMap alignedTo(const HeightMap& scan, const HeightMap& counter_surface,
                    const SurfacePose& pose, Beyond beyond = Beyond::kInvalid);

/// A flat counter-surface on the scan's grid, tilted as above: z = x tan(tilt_x) + y tan(tilt_y).
/// CV_64FC1, metres.
/// @throw OptionsError if a tilt is out of range.
HeightMap tiltedFlat(const HeightMap& scan, double tilt_x, double tilt_y);

}  // namespace mems_stiction
