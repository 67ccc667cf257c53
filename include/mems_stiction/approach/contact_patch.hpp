#pragma once

/// A contact patch: a connected set of cells in interference, with everything that its spherical caps are made from.
/// All attributes are additive, so that two patches merge in constant time.

#include <cstdint>

#include "mems_stiction/approach/gap_field.hpp"

namespace mems_stiction {

/// Sums over the boundary edges of a patch. An edge joins a cell inside to a valid neighbour outside; it counts at its
/// midpoint with the mean of both cells. Coordinates are in half pixels (integers, so that adding and taking away an
/// edge leaves no trace); heights are on GapField's level [m].
struct BoundarySums {
  double count = 0.0;
  double x = 0.0, y = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  double gap = 0.0, x_gap = 0.0, y_gap = 0.0;
  double lower = 0.0, x_lower = 0.0, y_lower = 0.0;

  /// The edge between two neighbouring cells; sign +1 adds it, -1 takes it away.
  void addEdge(const GapField& field, int row, int col, int neighbour_row, int neighbour_col, int sign);
  /// The edges of one cell to its four neighbours, in the order of Side; a sign of 0 leaves an edge out.
  /// @param gaps of the cell's neighbours [m]; not read where the sign is 0
  void addEdges(const GapField& field, const GridCell& cell, double gap, const double (&gaps)[4],
                const double (&signs)[4]);
  BoundarySums& operator+=(const BoundarySums& other);
};

enum Side { kLeft = 0, kRight = 1, kTop = 2, kBottom = 3 };

/// A cell at one side of a patch's bounding box, and what lies beyond.
struct ExtremeCell {
  std::int32_t cell = 0;
  double gap = 0.0;      ///< [m]
  double outside = 0.0;  ///< gap of the neighbour beyond the box [m]; infinite if that is invalid or not in the frame
};

struct ContactPatch {
  std::int32_t area = 0;  ///< [cells]
  std::int32_t min_col = 0, max_col = 0, min_row = 0, max_row = 0;
  /// Deepest cell (smallest gap, then smallest index) among those that touch each side of the bounding box.
  ExtremeCell extreme[4];
  std::int32_t deepest = 0;  ///< cell with the smallest gap, then the smallest index
  double deepest_gap = 0.0;  ///< its gap [m]
  double latest_gap = 0.0;   ///< largest gap among its cells [m]
  BoundarySums boundary;

  /// A patch of one cell, its boundary still empty.
  /// @param outside gaps of its four neighbours, in the order of Side [m]; infinite where there is none
  static ContactPatch ofCell(const GridCell& cell, double gap, const double (&outside)[4]);
  /// Adds one cell, but not its edges.
  void addCell(const GridCell& cell, double gap, const double (&outside)[4]);
  /// Adds the attributes of `other`, but not the edges between the two, which the caller takes away.
  void merge(const ContactPatch& other);
};

}  // namespace mems_stiction
