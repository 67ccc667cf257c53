#pragma once

/// @file
/// The gap between two surfaces at first touch: g = z2 - z1 - min(z2 - z1) >= 0 (section 2 of the
/// paper).

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "approach/cell_order.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "numeric/large_pages.hpp"

namespace mems_stiction {

/// The gaps of a frame by cell index, read from its relief as it is stored.
template <typename Scalar>
struct StoredGaps {
  const Scalar* relief;
  double top;
  double operator[](std::ptrdiff_t cell) const { return top - static_cast<double>(relief[cell]); }
};

/// Some cells of a frame, row by row.
struct PressedCells {
  std::vector<int> row_begin;         ///< of each row's cells, and the end of the last one's
  std::vector<std::int32_t> columns;  ///< of each cell

  std::size_t count() const { return columns.size(); }
};

/// Row-major over the frame. Cells that are invalid in either surface have an infinite gap: they
/// never come into contact and are left out of every sum. compute() reuses the memory of the
/// previous frame.
///
/// What is kept is the relief z1 - z2, in the precision of the scan where the upper surface is
/// flat, and the gap is what lies between it and its highest point: a scan in single precision then
/// costs 4 bytes a cell, and no digits.
class GapField {
 public:
  /// @throw SurfaceError if the grids differ or no pixel is valid in both, or if gaps lie more than
  /// 1e100 m apart.
  void compute(const SurfacePair& surfaces);
  /// The gaps of another field whose relief has been lowered cell by cell [m], as a plate that
  /// tilts or bends does for itself.
  void lower(const GapField& field, const cv::Mat1d& lowering);
  /// The same of some cells alone.
  void lower(const GapField& field, const PressedCells& cells, const std::vector<double>& lowering);

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  double pitchX() const { return pitch_x_; }
  double pitchY() const { return pitch_y_; }
  double cellArea() const { return pitch_x_ * pitch_y_; }
  int cellCount() const { return rows_ * cols_; }
  int validCount() const { return valid_count_; }
  /// Whether a cell lies in the frame; its index need not fit.
  bool contains(const GridCell& cell) const {
    return cell.row >= 0 && cell.row < rows_ && cell.col >= 0 && cell.col < cols_;
  }
  GridCell cellAt(int row, int col) const { return {row, col, row * cols_ + col}; }
  GridCell cellAt(int index) const { return {index / cols_, index % cols_, index}; }

  double gap(int cell) const {
    const auto place = static_cast<std::size_t>(cell);
    return top_ - (is_single_ ? static_cast<double>(single_relief_[place]) : relief_[place]);
  }
  /// read(StoredGaps) of a scalar that is known to the compiler, for code that asks for many gaps;
  /// returns what it returns.
  template <typename Reader>
  auto readGaps(const Reader& read) const {
    return is_single_ ? read(StoredGaps<float>{single_relief_.data(), top_})
                      : read(StoredGaps<double>{relief_.data(), top_});
  }
  /// - @p gaps room for cols() of them [m]
  void gapsOfRow(int row, double* gaps) const;
  double largestGap() const { return largest_gap_; }
  double meanGap() const { return mean_gap_; }
  /// Root mean square of the gap about its mean [m]: the composite rms height of what was compared,
  /// cell by cell.
  double rmsGap() const { return rms_gap_; }

  bool upperIsFlat() const { return upper_is_flat_; }
  /// z1 from an arbitrary but fixed level [m], so that a stage offset costs no digits. z2 = z1 + g
  /// on the same level.
  double lowerHeight(int cell) const {
    return upper_is_flat_ ? -gap(cell) : lower_[static_cast<std::size_t>(cell)];
  }

  /// Asks the memory for z1 of a cell and of those above and below it, unless the upper surface is
  /// flat.
  void prefetchLower(int cell) const;

  static constexpr double kInvalidGap = std::numeric_limits<double>::infinity();

 private:
  template <typename Grid>
  void takeGrid(const Grid& grid);
  void computeAgainstPlane(const HeightMap& lower);
  void computeBetween(const HeightMap& lower, const HeightMap& upper);
  /// - @p fill_row(row, line) writes a row's z1 - z2 [m], not finite where it is not valid
  template <typename Scalar, typename RowSource>
  void fillRelief(LargePageVector<Scalar>& relief, const RowSource& fill_row);
  template <typename LowerScalar, typename UpperScalar>
  void subtractSurfaces(const HeightMap& lower, const HeightMap& upper);

  int rows_ = 0;
  int cols_ = 0;
  double pitch_x_ = 0.0;
  double pitch_y_ = 0.0;
  int valid_count_ = 0;
  double largest_gap_ = 0.0;
  double mean_gap_ = 0.0;
  double rms_gap_ = 0.0;
  bool upper_is_flat_ = true;
  bool is_single_ = false;
  double top_ = 0.0;                      ///< highest point of the relief [m]
  LargePageVector<double> relief_;        ///< z1 - z2 [m]; -infinity where it is not valid
  LargePageVector<float> single_relief_;  ///< in its place, if is_single_
  std::vector<double> lower_;
};

/// Columns of a row's cells with a gap in [from, limit), in ascending order.
/// - @p gaps of the row's `cols` cells [m]
/// - @p columns room for as many
/// @return how many there are
int columnsBetween(double from, double limit, const double* gaps, int cols, std::int32_t* columns);

}  // namespace mems_stiction
