#pragma once

/// Figures that hang on the grid: the same set-up at several resolutions, and at each over several
/// phases of the grid (where the apex lies between the pixels), since a single one may be right by
/// chance.

#include <functional>

#include "verification/row.hpp"

namespace mems_stiction {
namespace verification {

/// Where the apex lies between the pixels [pixels], each in [0, 1).
struct Phase {
  double x = 0.0;
  double y = 0.0;
};

/// The grids that rows are computed on.
struct Grids {
  std::string resolution;           ///< what is counted
  std::vector<double> resolutions;  ///< ascending, at least three
  int phases = 8;
};

/// The figures of a set-up at a resolution, one per row.
using Figures = std::function<std::vector<double>(double resolution, const Phase& phase)>;

/// Fills in what was computed: the value of the finest grid at its worst phase, and the errors by
/// resolution.
/// @param rows made by limit()
std::vector<Row> onGrids(std::vector<Row> rows, const Grids& grids, const Figures& figures);

}  // namespace verification
}  // namespace mems_stiction
