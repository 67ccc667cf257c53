#pragma once

/// @file
/// A contact patch: a connected set of cells in interference, with everything that its spherical caps are made from.
/// All attributes are additive, so that two patches merge in constant time.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "mems_stiction/approach/gap_field.hpp"
#include "mems_stiction/base/lanes.hpp"
#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {

/// What the processor moves between memory and cache at once [bytes].
constexpr std::size_t kCacheLine = 64;

/// Sums over the boundary edges of a patch. An edge joins a cell inside to a valid neighbour outside; it counts at its
/// midpoint with the mean of both cells. Coordinates are in half pixels (integers, so that adding and taking away an
/// edge leaves no trace); heights are on GapField's level [m].
struct BoundarySums {
  double count = 0.0, gap = 0.0;
  double x = 0.0, x_gap = 0.0;
  double y = 0.0, y_gap = 0.0;
  double xx = 0.0, yy = 0.0, xy = 0.0;
  double lower = 0.0, x_lower = 0.0, y_lower = 0.0;

  /// The edge between two neighbouring cells; sign +1 adds it, -1 takes it away.
  void addEdge(const GapField& field, int row, int col, int neighbour_row, int neighbour_col, int sign);
  /// What changes when a cell comes into contact: edges to neighbours that are apart come in, those to neighbours that
  /// came into contact before are inside now and go.
  /// - @p gaps of the cell's four neighbours, in the order of Side [m]; infinite where there is none
  void addEdges(const GapField& field, const GridCell& cell, double gap, const double (&gaps)[4]);
  BoundarySums& operator+=(const BoundarySums& other);

 private:
  /// The part of addEdges() that a rough upper surface needs.
  void addLowerEdges(const GapField& field, const GridCell& cell, const Lanes& signs);
};

enum Side { kLeft = 0, kRight = 1, kTop = 2, kBottom = 3 };

/// A cell at one side of a patch's bounding box, and what lies beyond.
struct ExtremeCell {
  std::int32_t cell = 0;
  double gap = 0.0;      ///< [m]
  double outside = 0.0;  ///< gap of the neighbour beyond the box [m]; infinite if that is invalid or not in the frame
};

/// A connected set of contact cells, as sums that add up when patches merge. What every cell changes comes first, in two
/// cache lines; the sides of the box are in the next two.
struct alignas(kCacheLine) ContactPatch {
  std::int32_t area = 0;  ///< [cells]
  std::int32_t min_col = 0, max_col = 0, min_row = 0, max_row = 0;
  std::int32_t deepest = 0;  ///< cell with the smallest gap, then the smallest index
  double deepest_gap = 0.0;  ///< its gap [m]
  double latest_gap = 0.0;   ///< largest gap among its cells [m]
  BoundarySums boundary;
  /// Deepest cell (smallest gap, then smallest index) among those that touch each side of the bounding box.
  ExtremeCell extreme[4];

  /// Adds one cell, but not its edges; a patch without cells begins with it.
  /// - @p outside gaps of its four neighbours, in the order of Side [m]; infinite where there is none
  void addCell(const GridCell& cell, double gap, const double (&outside)[4]);
  /// The part of addCell() for a cell at the sides of the bounding box or beyond them.
  void extendBox(const GridCell& cell, double gap, const double (&outside)[4]);
  /// Adds the attributes of `other`, but not the edges between the two, which the caller takes away.
  void merge(const ContactPatch& other);
};

// The sweep's innermost work, here so that it is compiled into the sweep for the processor's instructions.

MEMS_STICTION_INLINE void BoundarySums::addEdges(const GapField& field, const GridCell& cell, double cell_gap,
                                                 const double (&gaps)[4]) {
  // left and top neighbours have smaller indices: of equal gaps they come first
  constexpr LaneMask kComesFirst{-1, 0, -1, 0};
  Lanes neighbour;
  load(gaps, neighbour);
  const Lanes zero{};
  const Lanes own = zero + cell_gap;
  const LaneMask is_apart = neighbour < GapField::kInvalidGap;
  const LaneMask is_inside = (neighbour < own) | ((neighbour == own) & kComesFirst);
  const Lanes signs = is_inside ? zero - 1.0 : (is_apart ? zero + 1.0 : zero);
  const Lanes edges = signs * 0.5 * (own + (is_apart ? neighbour : zero));

  // Number of edges and sum of their gaps side by side, in pairs: over left and top with the first, right and bottom
  // with the second. All edges are half a pixel pitch, one unit, from the cell's centre: moments follow from few
  // products.
  const Lanes first = __builtin_shuffle(signs, edges, LaneMask{0, 4, 2, 6});
  const Lanes second = __builtin_shuffle(signs, edges, LaneMask{1, 5, 3, 7});
  const Lanes sums = first + second;
  const Lanes differences = second - first;
  const LanePair horizontal{sums[0], sums[1]};
  const LanePair vertical{sums[2], sums[3]};
  const LanePair total = horizontal + vertical;
  const LanePair rightwards{differences[0], differences[1]};
  const LanePair downwards{differences[2], differences[3]};
  const double center_x = 2 * cell.col;
  const double center_y = 2 * cell.row;
  const LanePair x_sums = total * center_x + rightwards;
  const LanePair y_sums = total * center_y + downwards;
  count += total[0];
  gap += total[1];
  x += x_sums[0];
  x_gap += x_sums[1];
  y += y_sums[0];
  y_gap += y_sums[1];
  xx += (x_sums[0] + rightwards[0]) * center_x + horizontal[0];
  yy += (y_sums[0] + downwards[0]) * center_y + vertical[0];
  xy += x_sums[0] * center_y + downwards[0] * center_x;
  if (!field.upperIsFlat()) addLowerEdges(field, cell, signs);  // against a plane it is the gap, turned over
}

MEMS_STICTION_INLINE void ContactPatch::addCell(const GridCell& cell, double gap, const double (&outside)[4]) {
  if (area == 0) {
    area = 1;
    min_col = max_col = cell.col;
    min_row = max_row = cell.row;
    for (int side = 0; side < 4; ++side) extreme[side] = {cell.index, gap, outside[side]};
    deepest = cell.index;
    deepest_gap = latest_gap = gap;
    return;
  }
  // most cells lie inside the box; which of its sides the others extend is hard to predict
  const bool is_inside = static_cast<int>(cell.col > min_col) & static_cast<int>(cell.col < max_col) &
                         static_cast<int>(cell.row > min_row) & static_cast<int>(cell.row < max_row);
  if (!is_inside) extendBox(cell, gap, outside);
  if (comesBefore(gap, cell.index, deepest_gap, deepest)) {
    deepest = cell.index;
    deepest_gap = gap;
  }
  latest_gap = std::max(latest_gap, gap);
  ++area;
}

}  // namespace mems_stiction
