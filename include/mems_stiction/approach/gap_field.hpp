#pragma once

/// @file
/// The gap between two surfaces at first touch: g = z2 - z1 - min(z2 - z1) >= 0 (section 2 of the paper).

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// A cell of the frame by row and column, and by its index row cols + col: each form where the other would cost a
/// division.
struct GridCell {
  int row = 0;
  int col = 0;
  int index = 0;
};

/// The order in which cells come into contact: by gap [m], then by index, so that no two are equal.
inline bool comesBefore(double gap, int cell, double other_gap, int other) {
  return gap < other_gap || (gap == other_gap && cell < other);
}

/// Row-major over the frame. Cells that are invalid in either surface have an infinite gap: they never come into
/// contact and are left out of every sum. compute() reuses the memory of the previous frame.
class GapField {
 public:
  /// Against a plane. @throw SurfaceError if no pixel is valid.
  void compute(const HeightMap& lower);
  /// @throw SurfaceError if the grids differ or no pixel is valid in both.
  void compute(const HeightMap& lower, const HeightMap& upper);

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  double pitchX() const { return pitch_x_; }
  double pitchY() const { return pitch_y_; }
  double cellArea() const { return pitch_x_ * pitch_y_; }
  int cellCount() const { return rows_ * cols_; }
  int validCount() const { return valid_count_; }
  GridCell cellAt(int row, int col) const { return {row, col, row * cols_ + col}; }
  GridCell cellAt(int index) const { return {index / cols_, index % cols_, index}; }

  const std::vector<double>& gaps() const { return gap_; }
  double gap(int cell) const { return gap_[static_cast<std::size_t>(cell)]; }
  bool isValid(int cell) const { return gap(cell) < kInvalidGap; }
  double largestGap() const { return largest_gap_; }
  double meanGap() const { return mean_gap_; }
  /// Root mean square of the gap about its mean [m]: the composite rms height of what was compared, cell by cell.
  double rmsGap() const { return rms_gap_; }

  /// Columns of a row's cells with a gap below the limit, in ascending order.
  /// - @p columns room for cols() of them
  /// @return how many there are
  int columnsBelow(double limit, int row, std::int32_t* columns) const;

  bool upperIsFlat() const { return upper_is_flat_; }
  /// z1 from an arbitrary but fixed level [m], so that a stage offset costs no digits. z2 = z1 + g on the same level.
  double lowerHeight(int cell) const { return upper_is_flat_ ? -gap(cell) : lower_[static_cast<std::size_t>(cell)]; }

  static constexpr double kInvalidGap = std::numeric_limits<double>::infinity();

 private:
  template <typename Scalar>
  void computeAgainstPlane(const cv::Mat& heights);
  /// z2 - z1 into gap_, z1 into lower_; returns the smallest separation.
  template <typename LowerScalar, typename UpperScalar>
  double separate(const HeightMap& lower, const HeightMap& upper);
  void measure();

  int rows_ = 0;
  int cols_ = 0;
  double pitch_x_ = 0.0;
  double pitch_y_ = 0.0;
  int valid_count_ = 0;
  double largest_gap_ = 0.0;
  double mean_gap_ = 0.0;
  double rms_gap_ = 0.0;
  bool upper_is_flat_ = true;
  std::vector<double> gap_;
  std::vector<double> lower_;
};

}  // namespace mems_stiction
