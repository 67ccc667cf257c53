#pragma once

/// @file
/// Who else shows the pixels of a matrix, for those who write over the memory of the last frame.

#include <opencv2/core/mat.hpp>

namespace mems_stiction {

/// Whether somebody else shows these pixels: they must not be written.
inline bool isShared(const cv::Mat& pixels) {
  return pixels.u != nullptr && pixels.u->refcount > 1;
}

/// Makes a matrix of this size and type that nobody else shows: the one that is there, if it can be
/// written over.
inline void makeWritable(cv::Mat& pixels, int rows, int cols, int type) {
  if (isShared(pixels)) pixels.release();
  pixels.create(rows, cols, type);
}

}  // namespace mems_stiction
