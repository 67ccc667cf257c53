#include "verification/grid_convergence.hpp"

#include <cmath>
#include <limits>

namespace mems_stiction {
namespace verification {
namespace {

/// Points that fill the square evenly: the two-dimensional golden ratio sequence.
Phase phaseOf(int index) {
  constexpr double kRatio = 1.3247179572447460;  // of x^3 = x + 1
  const double x = 0.5 + index / kRatio;
  const double y = 0.5 + index / kRatio / kRatio;
  return {x - std::floor(x), y - std::floor(y)};
}

}  // namespace

std::vector<Row> onGrids(std::vector<Row> rows, const Grids& grids, const Figures& figures) {
  for (Row& row : rows) {
    row.convergence->resolution = grids.resolution;
    row.convergence->resolutions = grids.resolutions;
  }
  for (const double resolution : grids.resolutions) {
    std::vector<double> squares(rows.size(), 0.0);
    std::vector<double> worst(rows.size(), -1.0);
    for (int index = 0; index < grids.phases; ++index) {
      const std::vector<double> found = figures(resolution, phaseOf(index));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double before = rows[i].computed;
        rows[i].computed = i < found.size() ? found[i] : std::numeric_limits<double>::quiet_NaN();
        const double error = rows[i].error();
        squares[i] += error * error;
        if (std::isnan(worst[i]) || error <= worst[i]) {
          rows[i].computed = before;
        } else {
          worst[i] = error;  // a NaN is the worst of all
        }
      }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].convergence->errors.push_back(std::sqrt(squares[i] / grids.phases));
    }
  }
  return rows;
}

}  // namespace verification
}  // namespace mems_stiction
