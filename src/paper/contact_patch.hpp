#pragma once

/// @file
/// A contact patch: a connected set of cells in interference, with everything that its spherical
/// caps are made from. All attributes are additive, so that two patches merge in constant time.

#include <array>
#include <cstddef>
#include <cstdint>

#include "approach/cell_order.hpp"
#include "approach/gap_field.hpp"

namespace mems_stiction {

/// What the processor moves between memory and cache at once [bytes].
constexpr std::size_t kCacheLine = 64;

/// Sums over the boundary edges of a patch. An edge joins a cell inside to a valid neighbour
/// outside; it counts at its midpoint with the mean of both cells. Coordinates are in half pixels
/// (integers, so that adding and taking away an edge leaves no trace); heights are on GapField's
/// level [m].
struct BoundarySums {
  double count = 0.0, gap = 0.0;
  double x = 0.0, x_gap = 0.0;
  double y = 0.0, y_gap = 0.0;
  double xx = 0.0, yy = 0.0, xy = 0.0;
  double lower = 0.0, x_lower = 0.0, y_lower = 0.0;

  /// What changes when a cell comes into contact: edges to neighbours that are apart come in, those
  /// to neighbours that came into contact before are inside now and go.
  /// - @p gaps of its neighbours, by Side [m]; infinite where there is none
  void addEdges(const GridCell& cell, double gap, const double (&gaps)[4]);
  /// The part of it that a rough upper surface needs; against a plane it is the gap, turned over.
  void addLowerEdges(const GapField& field, const GridCell& cell, double gap,
                     const double (&gaps)[4]);
  BoundarySums& operator+=(const BoundarySums& other);
};

/// A cell at one side of a patch's bounding box, and what lies beyond.
struct ExtremeCell {
  std::int32_t cell = 0;
  double gap = 0.0;      ///< [m]
  double outside = 0.0;  ///< gap of the neighbour beyond the box [m]; infinite if that is invalid
                         ///< or not in the frame
};

/// A connected set of contact cells, as sums that add up when patches merge. What every cell
/// changes comes first, in two cache lines; the sides of the box are in the next two.
struct alignas(kCacheLine) ContactPatch {
  std::int32_t area = 0;  ///< [cells]
  std::int32_t min_col = 0, max_col = 0, min_row = 0, max_row = 0;
  std::int32_t deepest = 0;  ///< the cell that came into contact first
  double deepest_gap = 0.0;  ///< its gap [m]
  double latest_gap = 0.0;   ///< largest gap among its cells [m]
  BoundarySums boundary;
  /// By Side: the first in contact among the cells that touch this side of the bounding box.
  std::array<ExtremeCell, 4> extreme;

  /// Adds one cell, but not its edges; a patch without cells begins with it.
  /// - @p gaps of its neighbours, by Side [m]; infinite where there is none
  void addCell(const GridCell& cell, double gap, const double (&gaps)[4]);
  /// Adds the attributes of `other`, but not the edges between the two, which the caller takes
  /// away.
  void merge(const ContactPatch& other);

 private:
  /// Takes the cell for this side of the box if it lies beyond it, or came into contact before the
  /// one that is there.
  /// - @p bound of the box at this side
  /// - @p place column or row of the cell
  void extend(Side side, std::int32_t& bound, std::int32_t place, const ExtremeCell& cell);
};

}  // namespace mems_stiction
