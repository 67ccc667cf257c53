#pragma once

/// @file
/// From a contact patch to a couple of spherical caps (section 2.2 of the paper).
///
///     rc      = (Lx + Ly)/4, Lx and Ly the sides of the patch's bounding box
///     delta_c = height of each surface's summit over its base plane,
///               the least-squares plane through the boundary edges
///     R       = (rc^2 + delta_c^2)/(2 delta_c), the circle through three points of the
///             cross-section
///     1/R_i   = 1/R(z1) + 1/R(z2)                                                              (5)
///     theta   = tilt of the mid-surface's base plane
///
/// The bounding box is that of the patch's outline, interpolated between cell centres at the level
/// of the base planes (the mean gap of the boundary edges): rc and delta_c then belong to one
/// contour, and R does not jump by +-4 % at 25 pixels whenever the box grows by a pixel. At the
/// frame's border and beside invalid pixels the outline is the cell's edge.
///
/// Where it is degenerate: fewer than 4 edges or edges on one line give a level base plane; a
/// summit that is not above its base plane counts as flat; caps lower than a tenth of the patch's
/// largest interference say nothing about its shape (the centre is not the summit), and the
/// interference itself is taken for the cap height, at least the cut-off distance, so that no
/// radius is infinite.

#include <cmath>

#include "approach/gap_field.hpp"
#include "paper/contact_patch.hpp"

namespace mems_stiction {

/// The cell that is taken for the summit of both caps.
struct PatchCentre {
  GridCell cell;
  double gap = 0.0;  ///< [m]
};

/// Two spherical caps in place of one patch.
struct CapCouple {
  double cap_radius = 0.0;        ///< rc, of the base of both caps [m]
  double height = 0.0;            ///< delta_c of both caps together [m], > 0
  double composite_radius = 0.0;  ///< R_i of (5) [m]
  double squared_slope = 0.0;     ///< tan(theta)^2
  double cos_tilt = 1.0;          ///< cos(theta)
  GridCell centre;                ///< cell of the caps' summit

  double tilt() const { return std::atan(std::sqrt(squared_slope)); }  ///< theta [rad]
};

/// The cell in the middle of the patch's bounding box. A side with an even number of cells has two
/// middles: the deepest of them, so that a mirrored frame has the mirrored centre.
PatchCentre boxCentre(const ContactPatch& patch, const GapField& field);
/// The patch's deepest cell.
PatchCentre deepestCentre(const ContactPatch& patch, const GapField& field);

/// - @p centre boxCentre() if that belongs to the patch, otherwise deepestCentre().
/// - @p cutoff_distance D0, cap height of a patch without any relief [m], > 0
/// Depends on the patch's cells only, not on how far the approach has gone since they came in.
CapCouple capCouple(const ContactPatch& patch, const GapField& field, const PatchCentre& centre,
                    double cutoff_distance);

}  // namespace mems_stiction
