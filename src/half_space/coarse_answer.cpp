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
MEMS_STICTION_VECTORIZED void addHalves(std::size_t count, const float* a, const float* b,
                                        const float* c, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = a[i] + 0.5F * (b[i] + c[i]);
}

/// A quarter of each second value and of half of its neighbours; those of the first one and the
/// last one lie before and behind.
MEMS_STICTION_VECTORIZED void gather(std::size_t count, const float* from, float* to) {
  for (std::size_t i = 0; i < count; ++i) {
    to[i] = 0.25F * from[2 * i] + 0.125F * (from[2 * i - 1] + from[2 * i + 1]);
  }
}

/// The mean of two rows at each of their cells and, behind it, that of it and the next one; `next`
/// follows the last.
MEMS_STICTION_VECTORIZED void spread(std::size_t count, const float* a, const float* b, float next,
                                     float* to) {
  for (std::size_t i = 0; i < count; ++i) to[2 * i] = 0.5F * (a[i] + b[i]);
  for (std::size_t i = 0; i + 1 < count; ++i) to[2 * i + 1] = 0.5F * (to[2 * i] + to[2 * i + 2]);
  if (count > 0) to[2 * count - 1] = 0.5F * (to[2 * count - 2] + next);
}

}  // namespace

CoarseAnswer::CoarseAnswer(const HalfSpaceGrid& grid, const ElasticResponse& response, int threads,
                           SpectrumMemory& memory, const std::atomic<bool>* cancel)
    : grid_(grid),
      coarse_(grid.everySecond()),
      threads_(threads),
      stiffness_(coarse_, response, threads, memory, cancel),
      field_(coarse_.size(), 0.0F) {}

bool CoarseAnswer::fits(const HalfSpaceGrid& grid) {
  return std::min(grid.rows, grid.cols) >= kFewestCells;
}

void CoarseAnswer::find(double shift, const float* traction) {
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const auto coarse_cols = static_cast<std::size_t>(coarse_.cols);
  const bool is_odd = grid_.rows % 2 != 0;
  const std::vector<float> none(is_odd ? cols : 0, 0.0F);
  // the last row of an odd number is the first one's neighbour, and no row lies between
  const auto between = [&](int row) {
    if (is_odd && (row < 0 || row == grid_.rows)) return none.data();
    return traction + grid_.offset((row + grid_.rows) % grid_.rows);
  };
  forEachRow(coarse_.rows, threads_, [&](int coarse_row) {
    std::vector<float> line(cols + 2);  // a value before and one behind
    const int row = 2 * coarse_row;
    addHalves(cols, traction + grid_.offset(row), between(row - 1), between(row + 1),
              line.data() + 1);
    line.front() = cols % 2 != 0 ? 0.0F : line[cols];
    gather(coarse_cols, line.data() + 1, field_.data() + coarse_.offset(coarse_row));
  });
  stiffness_.precondition(shift, field_.data(), field_.data());
}

void CoarseAnswer::row(int row, float* displacement) const {
  const float* const one = field_.data() + coarse_.offset(row / 2);
  const float* const other =
      row % 2 == 0 ? one : field_.data() + coarse_.offset((row / 2 + 1) % coarse_.rows);
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const std::size_t pairs = cols / 2;
  const std::size_t next = pairs % static_cast<std::size_t>(coarse_.cols);
  const float behind = 0.5F * (one[next] + other[next]);
  spread(pairs, one, other, behind, displacement);
  if (cols % 2 != 0) displacement[cols - 1] = behind;
}

}  // namespace mems_stiction
