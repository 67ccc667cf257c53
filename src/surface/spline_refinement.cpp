#include "surface/spline_refinement.hpp"

#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kPhases = 4;
constexpr std::size_t kTaps = 4;

/// What the coarse cells -1, 0, 1, 2 give to the fine cells 0 to 3 of the cell 0.
struct Weights {
  float of[kTaps][kPhases];
};

/// The four moving averages of four cells that make one B-spline of the finer ones (1, 4, 10, 20,
/// 31, 40, 44, ...)/64.
constexpr Weights kToCoefficients = {{{10 / 64.0F, 4 / 64.0F, 1 / 64.0F, 0.0F},
                                      {44 / 64.0F, 40 / 64.0F, 31 / 64.0F, 20 / 64.0F},
                                      {10 / 64.0F, 20 / 64.0F, 31 / 64.0F, 40 / 64.0F},
                                      {0.0F, 0.0F, 1 / 64.0F, 4 / 64.0F}}};
/// The B-spline at quarters of a cell.
constexpr Weights kToValues = {{{64 / 384.0F, 27 / 384.0F, 8 / 384.0F, 1 / 384.0F},
                                {256 / 384.0F, 235 / 384.0F, 184 / 384.0F, 121 / 384.0F},
                                {64 / 384.0F, 121 / 384.0F, 184 / 384.0F, 235 / 384.0F},
                                {0.0F, 1 / 384.0F, 8 / 384.0F, 27 / 384.0F}}};

MEMS_STICTION_VECTORIZED void addRows(const Weights& weights, const float* coarse, std::size_t rows,
                                      std::size_t cols, float* line, float* fine) {
  const std::size_t coarse_cols = cols / kPhases + kSplineAround;
  for (std::size_t row = 0; row < rows; ++row) {
    const float* const above = coarse + row / kPhases * coarse_cols;
    const std::size_t phase = row % kPhases;
    for (std::size_t col = 0; col < coarse_cols; ++col) {
      line[col] = above[col] * weights.of[0][phase] +
                  above[coarse_cols + col] * weights.of[1][phase] +
                  above[2 * coarse_cols + col] * weights.of[2][phase] +
                  above[3 * coarse_cols + col] * weights.of[3][phase];
    }
    float* const values = fine + row * cols;
    for (std::size_t col = 0; col < cols / kPhases; ++col) {
      for (std::size_t i = 0; i < kPhases; ++i) {
        values[kPhases * col + i] +=
            line[col] * weights.of[0][i] + line[col + 1] * weights.of[1][i] +
            line[col + 2] * weights.of[2][i] + line[col + 3] * weights.of[3][i];
      }
    }
  }
}

}  // namespace

void addRefined(SplineRefinement refinement, const float* coarse, std::size_t rows,
                std::size_t cols, float* line, float* fine) {
  const bool to_values = refinement == SplineRefinement::kValues;
  addRows(to_values ? kToValues : kToCoefficients, coarse, rows, cols, line, fine);
}

}  // namespace mems_stiction
