#pragma once

/// @file
/// The discrete Fourier transform of a frame of real values, as far as it is not its own mirror
/// image, and the sums of products at a distance that follow from it.

#include <opencv2/core.hpp>

#include "numeric/constants.hpp"

namespace mems_stiction {

/// Wave number of one coefficient of a transform of `count` values [rad/m].
inline double waveNumber(int index, int count, double pitch) {
  const int wave = index <= count / 2 ? index : index - count;
  return 2.0 * kPi * wave / (count * pitch);
}

/// Transform of values in the corner of a frame of zeros, by row and column of the wave vector:
/// F(k_x, k_y) stands at row k_x <= frame.width/2 and column k_y; the other half is its complex
/// conjugate, F(-k_x, -k_y) = conj F(k_x, k_y).
/// - @p values rows x cols CV_64FC1, no larger than the frame
/// @return (frame.width/2 + 1) x frame.height CV_64FC2
cv::Mat halfSpectrum(const cv::Mat& values, const cv::Size& frame);

/// Sum of values(x) values(x + lag) over a frame that pads with zeros.
/// @return (2 half_rows + 1) x (2 half_cols + 1) CV_64FC1, lag 0 in the middle; the frame wraps
/// around larger lags than it
///         has room for
cv::Mat pairSums(const cv::Mat& values, const cv::Size& frame, int half_rows, int half_cols);

}  // namespace mems_stiction
