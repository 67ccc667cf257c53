#include "half_space/half_space_grid.hpp"

#include <initializer_list>

namespace mems_stiction {
namespace {

/// Elements to which rows are filled up, so that each starts on a cache line.
constexpr int kRowMultiple = 16;

/// The next length from `least` on that Fourier transforms are fast for: factors 2, 3, 5 and 7.
int fastLength(int least) {
  for (int length = least;; ++length) {
    int rest = length;
    for (const int factor : {2, 3, 5, 7}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return length;
  }
}

int strideOf(int cols) { return (cols + kRowMultiple - 1) / kRowMultiple * kRowMultiple; }

int transformedLength(int length, HalfSpaceBoundary boundary) {
  return boundary == HalfSpaceBoundary::kPeriodic ? length : fastLength(2 * length - 1);
}

}  // namespace

HalfSpaceGrid::HalfSpaceGrid(int frame_rows_in, int frame_cols_in, double pitch_x_in,
                             double pitch_y_in, HalfSpaceBoundary boundary_in)
    : frame_rows(frame_rows_in),
      frame_cols(frame_cols_in),
      pitch_x(pitch_x_in),
      pitch_y(pitch_y_in),
      boundary(boundary_in),
      rows(transformedLength(frame_rows, boundary)),
      cols(transformedLength(frame_cols, boundary)),
      stride(strideOf(cols)) {}

HalfSpaceGrid HalfSpaceGrid::everySecond() const {
  HalfSpaceGrid coarse(*this);
  for (int* const length : {&coarse.rows, &coarse.cols, &coarse.frame_rows, &coarse.frame_cols}) {
    *length = (*length + 1) / 2;
  }
  coarse.pitch_x *= 2.0;
  coarse.pitch_y *= 2.0;
  coarse.stride = strideOf(coarse.cols);
  return coarse;
}

}  // namespace mems_stiction
