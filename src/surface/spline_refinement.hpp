#pragma once

/// @file
/// A cubic spline over cells, seen by cells a quarter as wide.
///
/// The spline is the sum of cubic B-splines, one on each coarse cell, times its coefficient.
/// `kCoefficients` gives the coefficients with which B-splines of the fine cells make the same
/// curve, which is exact; `kValues` the curve at the fine cells.

#include <cstddef>

namespace mems_stiction {

enum class SplineRefinement { kCoefficients, kValues };

constexpr int kRefinedCells = 4;  ///< fine cells to a coarse one, along each axis
constexpr int kSplineBefore = 1;  ///< coarse cells that bear on the first fine one, before it
constexpr int kSplineAround =
    3;  ///< ... and before and behind all fine ones, beside one for each four

/// Adds what `coarse` makes to each of rows x cols fine cells, the first of which lies on the
/// coarse cell (1, 1).
/// - @p coarse (rows/4 + 3) x (cols/4 + 3) coefficients
/// - @p rows, @p cols multiples of 4
/// - @p line memory for cols/4 + 3 numbers
void addRefined(SplineRefinement refinement, const float* coarse, std::size_t rows,
                std::size_t cols, float* line, float* fine);

}  // namespace mems_stiction
