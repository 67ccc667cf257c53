#pragma once

/// @file
/// Roughly which smooth displacement answers a traction? (K + shift)^-1 on every second cell of
/// every second row, a quarter of the work:
///
///     (1/4) I (K + shift)^-1 I^T  I: bilinear interpolation from there to all cells; I^T/4 is the
///                                 mean about each of them
///
/// What varies from cell to cell is not answered; a preconditioner adds that. Source for
/// corrections from a coarser grid: Trottenberg, Oosterlee and Schueller, Multigrid (2001), chapter
/// 2.
///
///     CoarseAnswer answer(grid, response, threads, memory, cancel);
///     answer.find(shift, traction);
///     answer.row(i, displacement);  // of row i

#include <atomic>
#include <vector>

#include "half_space/half_space_grid.hpp"
#include "half_space/stiffness_operator.hpp"
#include "numeric/large_pages.hpp"

namespace mems_stiction {

/// Symmetric, and the same bits for any number of threads.
class CoarseAnswer {
 public:
  /// - @p response without an influence
  /// - @p memory, @p cancel as the operator's
  CoarseAnswer(const HalfSpaceGrid& grid, const ElasticResponse& response, int threads,
               SpectrumMemory& memory, const std::atomic<bool>* cancel);

  /// Whether a grid has so many cells that every second one tells what is smooth.
  static bool fits(const HalfSpaceGrid& grid);

  /// Finds what answers a traction, an array of the grid [Pa].
  /// - @p shift [Pa/m], > 0
  void find(double shift, const float* traction);
  /// A row of it [m]. May be called by several threads.
  void row(int row, float* displacement) const;

 private:
  HalfSpaceGrid grid_;
  HalfSpaceGrid coarse_;
  int threads_;
  StiffnessOperator<float> stiffness_;
  LargePageVector<float> field_;  ///< traction, then displacement, on the coarse grid
};

}  // namespace mems_stiction
