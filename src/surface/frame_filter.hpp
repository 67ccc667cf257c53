#pragma once

/// @file
/// A periodic frame of real values whose waves are multiplied with real gains, there and back, by
/// FFTW or, without it, by OpenCV.
///
/// CMake's MEMS_STICTION_WITH_FFTW chooses: frame_filter_fftw.cpp takes a third of the time
/// (doc/performance.md).
///
///     FrameFilter filter({768, 768}, 512);
///     for (int row = 0; row < 768; ++row) fill(filter.row(row));
///     filter.apply(gains);

#include <memory>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// The frames of one size, one after the other, in single precision. One object serves one thread
/// at a time.
class FrameFilter {
 public:
  /// - @p rows that are wanted back, from the first one on
  FrameFilter(const cv::Size& frame, int rows);
  ~FrameFilter();
  FrameFilter(FrameFilter&& other) noexcept;
  FrameFilter& operator=(FrameFilter&& other) noexcept;

  /// The values of a row, as many as the frame is wide. All are to be filled before apply(), and
  /// the wanted ones hold what it makes of them.
  float* row(int row);
  /// Transform, gains, inverse transform, neither divided by the number of pixels.
  /// - @p gains of the waves (x, y), CV_32FC1: x from 0 to half the width in their rows, y from 0
  /// to the height - 1 in their columns
  void apply(const cv::Mat& gains);

 private:
  struct Transforms;
  std::unique_ptr<Transforms> transforms_;
};

}  // namespace mems_stiction
