#pragma once

/// @file
/// NumPy's .npy files: a matrix of numbers (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).

#include <string>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Two dimensions, rows first; integers, float16, float32 and float64 of either byte order, in C or Fortran order.
/// @return a channel that takes settings
/// @throw FileError without a file name: another shape or type, cut off, too many numbers.
FileChannel parseNpy(const std::string& bytes);

}  // namespace mems_stiction
