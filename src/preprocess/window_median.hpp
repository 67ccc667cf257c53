#pragma once

/// @file
/// How far does each pixel lie from the median of its surroundings?
///
/// Windows of 3 x 3 and 5 x 5 pixels without an invalid one take a network of comparisons, four
/// windows side by side: columns are sorted once for all windows that share them, then the rows of
/// a window. In an array sorted by columns and rows, the median of 5 x 5 values is the median of
/// three: the largest on the diagonal above the middle one, the median of the middle diagonal, and
/// the smallest on the one below (the other values are known to lie below or above it). The others
/// are sorted out one by one. Both give the same bits.

#include <vector>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Keeps its memory from frame to frame.
class WindowMedian {
 public:
  /// A frame of this size, in windows of 2 half + 1 pixels a side, whose rows are to be written
  /// next.
  void setFrame(int rows, int cols, int half);
  /// Where the heights of a row go: cols values [m], invalid ones NaN.
  double* row(int row);
  /// Height less the median of the valid heights in the window: rows x cols values in the order of
  /// the frame, NaN where the pixel is invalid. Beyond the frame the surface goes on by its
  /// reflection through the border pixels, which keeps planes: windows at the border are as
  /// balanced as others. A window reaches no further than the frame is wide.
  void findResiduals(double* residuals);

 private:
  double* wideRow(int row);
  void fillMargins();
  void findByNetwork(int row, double* residuals);
  double plainResidual(int row, int col, std::vector<double>& window);

  int rows_ = 0;
  int cols_ = 0;
  int half_ = 0;
  int margin_rows_ = 0;
  int margin_cols_ = 0;
  std::size_t stride_ =
      0;  ///< values from one row to the next, whole packets and more than the margins need
  std::vector<double> wide_;    ///< the frame with its margins
  std::vector<char> has_hole_;  ///< of each row with its margins: a pixel is invalid
  std::vector<double>
      sorted_;  ///< the columns of one row of windows: smallest values, next ones, ...
  std::vector<double> window_;
};

}  // namespace mems_stiction
