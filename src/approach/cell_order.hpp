#pragma once

/// @file
/// The order in which cells come into contact: by gap, and of equal gaps as they stand in the
/// frame, row by row. No two cells are equal then. Of its neighbours, those to the left and above
/// stand before a cell, the others after it.

namespace mems_stiction {

/// A side of a cell, or of a box of cells; the order of everything that is kept by side.
enum Side { kLeft = 0, kRight = 1, kTop = 2, kBottom = 3 };
inline constexpr Side kSides[] = {kLeft, kRight, kTop, kBottom};

/// A cell of the frame by row and column, and by its index row cols + col: each form where the
/// other would cost a division.
struct GridCell {
  int row = 0;
  int col = 0;
  int index = 0;

  /// The next cell at this side, in the frame or not.
  /// - @p cols of the frame
  GridCell neighbour(Side side, int cols) const {
    constexpr int kRowStep[] = {0, 0, -1, 1};
    constexpr int kColStep[] = {-1, 1, 0, 0};
    return {row + kRowStep[side], col + kColStep[side],
            index + kRowStep[side] * cols + kColStep[side]};
  }
};

/// Whether a cell comes into contact before another one; gaps in [m], cells by index.
inline bool comesBefore(double gap, int cell, double other_gap, int other) {
  return gap < other_gap || (gap == other_gap && cell < other);
}

/// Whether the neighbour at this side comes into contact before a cell; gaps in [m], infinite where
/// there is no cell.
constexpr bool comesFirst(Side side, double neighbour_gap, double gap) {
  return side == kLeft || side == kTop ? neighbour_gap <= gap : neighbour_gap < gap;
}

}  // namespace mems_stiction
