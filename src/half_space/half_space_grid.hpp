#pragma once

/// @file
/// On which cells is the elastic problem solved? Those of the frame when its edges continue on the
/// opposite side; with free edges on a frame about twice as wide and high, whose additional cells
/// carry no traction, so that no part of the frame feels its periodic image.

#include <cstddef>

#include "mems_stiction/half_space/half_space_options.hpp"

namespace mems_stiction {

/// Rows and columns that are transformed, of which the first frame_rows x frame_cols are the frame.
struct HalfSpaceGrid {
  /// - @p frame_rows, @p frame_cols > 0
  /// - @p pitch_x, @p pitch_y [m], > 0
  HalfSpaceGrid(int frame_rows, int frame_cols, double pitch_x, double pitch_y,
                HalfSpaceBoundary boundary);

  /// Every second cell of every second row of it, the first ones included, round the ring; its
  /// frame is of no use.
  HalfSpaceGrid everySecond() const;

  std::size_t size() const {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(stride);
  }
  std::size_t offset(int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(stride);
  }
  /// Cells that are transformed.
  double cellCount() const { return static_cast<double>(rows) * cols; }
  double cellArea() const { return pitch_x * pitch_y; }
  double frameArea() const { return cellArea() * frame_rows * frame_cols; }

  int frame_rows;
  int frame_cols;
  double pitch_x;  ///< [m]
  double pitch_y;  ///< [m]
  HalfSpaceBoundary boundary;
  int rows;
  int cols;
  int stride;  ///< cells from one row to the next in arrays of the grid; those past cols are 0
};

}  // namespace mems_stiction
