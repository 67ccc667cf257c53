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

enum Side { kLeft = 0, kRight = 1, kTop = 2, kBottom = 3 };

/// What changes in BoundarySums when each of four cells comes into contact: edges to neighbours that are apart come in,
/// those to neighbours that came into contact before are inside now and go.
struct EdgeChanges {
  /// - @p own gaps of the four cells [m]
  /// - @p neighbours gaps of their neighbours, by Side [m]; infinite where there is none
  EdgeChanges(const Lanes& own, const Lanes (&neighbours)[4], const Lanes& col, const Lanes& row);

  Lanes sums[4];     ///< of each cell: count, gap, x, x_gap
  Lanes moments[4];  ///< of each cell: y, y_gap, xx, yy
  Lanes xy;
  Lanes signs[4];  ///< by Side: +1 for an edge that comes in, -1 for one that goes, 0 for none
};

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
  /// The edges of one of the cells that come into contact.
  /// - @p lane which of them
  void addEdges(const EdgeChanges& changes, std::size_t lane);
  /// The part of it that a rough upper surface needs; against a plane it is the gap, turned over.
  void addLowerEdges(const GapField& field, const GridCell& cell, const EdgeChanges& changes, std::size_t lane);
  BoundarySums& operator+=(const BoundarySums& other);
};

/// A cell at one side of a patch's bounding box, and what lies beyond.
struct ExtremeCell {
  std::int32_t cell = 0;
  double gap = 0.0;      ///< [m]
  double outside = 0.0;  ///< gap of the neighbour beyond the box [m]; infinite if that is invalid or not in the frame
};

/// One of them at each side, side by side.
class ExtremeCells {
 public:
  ExtremeCell operator[](Side side) const { return {cells_[side], gaps_[side], outside_[side]}; }
  void set(Side side, const ExtremeCell& extreme) {
    cells_[side] = extreme.cell;
    gaps_[side] = extreme.gap;
    outside_[side] = extreme.outside;
  }
  const Lanes& gaps() const { return gaps_; }
  const Lanes& outside() const { return outside_; }

  /// One cell is all there is.
  void begin(std::int32_t cell, double gap, const double (&outside)[4]);
  /// The cell takes the sides that it lies beyond, and those that it touches as the deepest; of cells of equal gaps the
  /// first one added keeps them.
  /// - @p beyond how far it lies beyond each side [cells]
  /// @return the sides that it takes
  IntegerLanes add(std::int32_t cell, double gap, const double (&outside)[4], const IntegerLanes& beyond);

 private:
  Lanes gaps_{};
  Lanes outside_{};
  IntegerLanes cells_{};
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
  ExtremeCells extreme;

  /// Adds one cell, but not its edges; a patch without cells begins with it. Cells of equal gaps are added in the order of
  /// the frame.
  /// - @p outside gaps of its four neighbours, in the order of Side [m]; infinite where there is none
  void addCell(const GridCell& cell, double gap, const double (&outside)[4]);
  /// Adds the attributes of `other`, but not the edges between the two, which the caller takes away.
  void merge(const ContactPatch& other);
};

// The sweep's innermost work, here so that it is compiled into the sweep for the processor's instructions.

MEMS_STICTION_INLINE EdgeChanges::EdgeChanges(const Lanes& own, const Lanes (&neighbours)[4], const Lanes& col,
                                              const Lanes& row) {
  const Lanes zero{};
  const auto edgesAt = [&](Side side, bool comes_first_of_equals, Lanes& edges) {
    const Lanes& gap = neighbours[side];
    const LaneMask is_apart = gap < GapField::kInvalidGap;
    const LaneMask is_inside = comes_first_of_equals ? gap <= own : gap < own;
    signs[side] = is_inside ? zero - 1.0 : (is_apart ? zero + 1.0 : zero);
    edges = signs[side] * 0.5 * (own + (is_apart ? gap : zero));
  };
  // left and top neighbours have smaller indices: of equal gaps they come first
  Lanes left, right, top, bottom;
  edgesAt(kLeft, true, left);
  edgesAt(kRight, false, right);
  edgesAt(kTop, true, top);
  edgesAt(kBottom, false, bottom);

  // All edges are half a pixel pitch, one unit, from the cell's centre: moments follow from few products.
  const Lanes center_x = 2.0 * col;
  const Lanes center_y = 2.0 * row;
  const Lanes horizontal = signs[kLeft] + signs[kRight];
  const Lanes vertical = signs[kTop] + signs[kBottom];
  const Lanes rightwards = signs[kRight] - signs[kLeft];
  const Lanes downwards = signs[kBottom] - signs[kTop];
  Lanes& count = sums[0];
  Lanes& gap = sums[1];
  Lanes& x = sums[2];
  Lanes& x_gap = sums[3];
  count = horizontal + vertical;
  gap = (left + right) + (top + bottom);
  x = count * center_x + rightwards;
  x_gap = gap * center_x + (right - left);
  Lanes& y = moments[0];
  Lanes& y_gap = moments[1];
  Lanes& xx = moments[2];
  Lanes& yy = moments[3];
  y = count * center_y + downwards;
  y_gap = gap * center_y + (bottom - top);
  xx = (x + rightwards) * center_x + horizontal;
  yy = (y + downwards) * center_y + vertical;
  xy = x * center_y + downwards * center_x;
  transpose(count, gap, x, x_gap);
  transpose(y, y_gap, xx, yy);
}

MEMS_STICTION_INLINE void BoundarySums::addEdges(const EdgeChanges& changes, std::size_t lane) {
  const Lanes sums = Lanes{count, gap, x, x_gap} + changes.sums[lane];
  const Lanes moments = Lanes{y, y_gap, xx, yy} + changes.moments[lane];
  count = sums[0];
  gap = sums[1];
  x = sums[2];
  x_gap = sums[3];
  y = moments[0];
  y_gap = moments[1];
  xx = moments[2];
  yy = moments[3];
  xy += changes.xy[lane];
}

MEMS_STICTION_INLINE void ExtremeCells::begin(std::int32_t cell, double gap, const double (&outside)[4]) {
  cells_ = IntegerLanes{} + cell;
  gaps_ = Lanes{} + gap;
  load(outside, outside_);
}

MEMS_STICTION_INLINE IntegerLanes ExtremeCells::add(std::int32_t cell, double gap, const double (&outside)[4],
                                                    const IntegerLanes& beyond) {
  const Lanes new_gaps = Lanes{} + gap;
  const IntegerLanes new_cells = IntegerLanes{} + cell;
  Lanes new_outside;
  load(outside, new_outside);
  const LaneMask is_deeper = new_gaps < gaps_;
  const LaneMask is_new =
      __builtin_convertvector(beyond > 0, LaneMask) | (__builtin_convertvector(beyond == 0, LaneMask) & is_deeper);
  const IntegerLanes is_new_side = __builtin_convertvector(is_new, IntegerLanes);
  gaps_ = is_new ? new_gaps : gaps_;
  outside_ = is_new ? new_outside : outside_;
  cells_ = is_new_side ? new_cells : cells_;
  return is_new_side;
}

MEMS_STICTION_INLINE void ContactPatch::addCell(const GridCell& cell, double gap, const double (&outside)[4]) {
  if (area == 0) {
    area = 1;
    min_col = max_col = cell.col;
    min_row = max_row = cell.row;
    extreme.begin(cell.index, gap, outside);
    deepest = cell.index;
    deepest_gap = latest_gap = gap;
    return;
  }
  // which sides of the box a cell extends is random: all four side by side, without a branch
  const IntegerLanes box{min_col, max_col, min_row, max_row};
  const IntegerLanes place{cell.col, cell.col, cell.row, cell.row};
  constexpr IntegerLanes kIsLower{-1, 0, -1, 0};
  const IntegerLanes distance = place - box;
  const IntegerLanes beyond = (distance ^ kIsLower) - kIsLower;  // distance, or minus it
  const IntegerLanes is_new = extreme.add(cell.index, gap, outside, beyond);
  const IntegerLanes extended = is_new ? place : box;
  min_col = extended[kLeft];
  max_col = extended[kRight];
  min_row = extended[kTop];
  max_row = extended[kBottom];
  if (gap < deepest_gap) {
    deepest = cell.index;
    deepest_gap = gap;
  }
  latest_gap = std::max(latest_gap, gap);
  ++area;
}

}  // namespace mems_stiction
