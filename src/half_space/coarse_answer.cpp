#include "half_space/coarse_answer.hpp"

#include <algorithm>
#include <cstddef>

#include "half_space/row_work.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

/// Rows and columns that are worth halving.
constexpr int kFewestCells = 16;

/// a + (b + c)/2.
MEMS_STICTION_VECTORIZED void addHalves(std::size_t count, const float* a, const float* b, const float* c, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = a[i] + 0.5F * (b[i] + c[i]);
}

/// (a + b)/2.
MEMS_STICTION_VECTORIZED void mean(std::size_t count, const float* a, const float* b, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = 0.5F * (a[i] + b[i]);
}

/// A quarter of each second value and of half of its neighbours; those of the first one and the last one lie before and behind.
MEMS_STICTION_VECTORIZED void gather(std::size_t count, const float* from, float* to) {
  for (std::size_t i = 0; i < count; ++i) {
    to[i] = 0.25F * from[2 * i] + 0.125F * (from[2 * i - 1] + from[2 * i + 1]);
  }
}

/// Each value and, behind it, the mean of it and the next one.
MEMS_STICTION_VECTORIZED void spread(std::size_t count, const float* from, float* to) {
  for (std::size_t i = 0; i < count; ++i) {
    to[2 * i] = from[i];
    to[2 * i + 1] = 0.5F * (from[i] + from[i + 1]);
  }
}

}  // namespace

CoarseAnswer::CoarseAnswer(const HalfSpaceGrid& grid, const ElasticResponse& response, int threads,
                           SpectrumMemory& memory, const std::atomic<bool>* cancel)
    : grid_(grid),
      coarse_(grid.everySecond()),
      threads_(threads),
      stiffness_(coarse_, response, threads, memory, cancel),
      field_(coarse_.size(), 0.0F) {}

bool CoarseAnswer::fits(const HalfSpaceGrid& grid) { return std::min(grid.rows, grid.cols) >= kFewestCells; }

void CoarseAnswer::find(double shift, const float* traction) {
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const auto coarse_cols = static_cast<std::size_t>(coarse_.cols);
  forEachRow(coarse_.rows, threads_, [&](int coarse_row) {
    std::vector<float> line(cols + 2);  // a value before and one behind
    const int row = 2 * coarse_row;
    const float* const here = traction + grid_.offset(row);
    // the last row of an odd number is the first one's neighbour, and no row lies between
    const std::vector<float> none(row == 0 || row + 1 >= grid_.rows ? cols : 0, 0.0F);
    const bool is_odd = grid_.rows % 2 != 0;
    const float* const above = row > 0  ? traction + grid_.offset(row - 1)
                               : is_odd ? none.data()
                                        : traction + grid_.offset(grid_.rows - 1);
    const float* const below = row + 1 < grid_.rows ? traction + grid_.offset(row + 1) : none.data();
    addHalves(cols, here, above, below, line.data() + 1);
    line.front() = cols % 2 != 0 ? 0.0F : line[cols];
    gather(coarse_cols, line.data() + 1, field_.data() + coarse_.offset(coarse_row));
  });
  stiffness_.precondition(shift, field_.data(), field_.data());
}

void CoarseAnswer::row(int row, float* displacement) const {
  const auto coarse_cols = static_cast<std::size_t>(coarse_.cols);
  std::vector<float> line(coarse_cols + 1);
  const float* const first = field_.data() + coarse_.offset(row / 2);
  if (row % 2 == 0) {
    std::copy_n(first, coarse_cols, line.begin());
  } else {
    mean(coarse_cols, first, field_.data() + coarse_.offset((row / 2 + 1) % coarse_.rows), line.data());
  }
  line.back() = line.front();
  const std::size_t pairs = static_cast<std::size_t>(grid_.cols) / 2;
  spread(pairs, line.data(), displacement);
  if (grid_.cols % 2 != 0) displacement[2 * pairs] = line[pairs];
}

}  // namespace mems_stiction
