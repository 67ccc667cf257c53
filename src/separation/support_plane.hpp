#pragma once

/// @file
/// On which three places does a rigid plate come to lie that is free to tilt and loaded in its
/// middle?
///
/// The plate is the plane over the relief that is lowest over the frame's middle: a linear program
/// in three unknowns, whose solution touches the relief's convex hull at the corners of the
/// triangle over the middle. Solved by exchange: the place that sticks out of the plane by most
/// takes the part of one corner, so that the middle stays within. Each exchange raises the plane
/// over the middle; none of them leaves a cell out.

#include <optional>

#include "approach/gap_field.hpp"

namespace mems_stiction {

/// Slopes of a plane through the frame's middle [-]: along the columns' axis x, and along y.
struct PlaneSlopes {
  double x = 0.0;
  double y = 0.0;
};

/// Place of a cell from the frame's middle [m].
struct PlaceOnPlate {
  double x = 0.0;
  double y = 0.0;
};
inline PlaceOnPlate placeOnPlate(const GapField& field, const GridCell& cell) {
  return {(cell.col - 0.5 * (field.cols() - 1)) * field.pitchX(),
          (cell.row - 0.5 * (field.rows() - 1)) * field.pitchY()};
}

/// The slopes of the plate; none where the valid cells do not surround the frame's middle.
std::optional<PlaneSlopes> supportPlane(const GapField& field);

}  // namespace mems_stiction
