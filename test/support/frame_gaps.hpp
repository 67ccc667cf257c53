#pragma once

#include <vector>

#include "approach/gap_field.hpp"

namespace mems_stiction {

/// Whether the cell is valid in both surfaces.
inline bool isValid(const GapField& field, int cell) {
  return field.gap(cell) < GapField::kInvalidGap;
}

/// The gaps of all cells in the order of the frame [m]; infinite where a cell is not valid.
inline std::vector<double> frameGaps(const GapField& field) {
  std::vector<double> gaps;
  for (int cell = 0; cell < field.cellCount(); ++cell) gaps.push_back(field.gap(cell));
  return gaps;
}

}  // namespace mems_stiction
