#include "mems_stiction/approach/dale_map.hpp"

#include <algorithm>

namespace mems_stiction {

void DaleMap::begin(const GapField& field) {
  field_ = &field;
  count_ = 0;
  dale_.assign(static_cast<std::size_t>(field.cellCount()), kUnknown);
}

template <typename Scalar>
GridCell DaleMap::below(const GridCell& cell, const StoredGaps<Scalar>& gaps) const {
  const int cols = field_->cols();
  const double gap = gaps[cell.index];
  // of equal gaps the smaller index comes first
  if (cell.col > 0 && gaps[cell.index - 1] <= gap) return {cell.row, cell.col - 1, cell.index - 1};
  if (cell.row > 0 && gaps[cell.index - cols] <= gap) return {cell.row - 1, cell.col, cell.index - cols};
  const double right = cell.col + 1 < cols ? gaps[cell.index + 1] : GapField::kInvalidGap;
  const double bottom = cell.row + 1 < field_->rows() ? gaps[cell.index + cols] : GapField::kInvalidGap;
  if (right < gap && right <= bottom) return {cell.row, cell.col + 1, cell.index + 1};
  if (bottom < gap) return {cell.row + 1, cell.col, cell.index + cols};
  return cell;
}

template <typename Scalar>
std::int32_t DaleMap::follow(const GridCell& start, const StoredGaps<Scalar>& gaps) {
  path_.clear();
  GridCell cell = start;
  while (at(cell) == kUnknown) {
    path_.push_back(cell.index);
    const GridCell next = below(cell, gaps);
    if (next.index == cell.index) dale_[place(cell)] = count_++;
    cell = next;
  }
  const std::int32_t dale = at(cell);
  for (const std::int32_t index : path_) dale_[static_cast<std::size_t>(index)] = dale;
  return dale;
}

std::int32_t DaleMap::follow(const GridCell& start) {
  return field_->readGaps([&](const auto& gaps) { return follow(start, gaps); });
}

void DaleMap::findInRow(int row, const std::int32_t* cols, int count, const double* gaps, const double* gaps_above) {
  const int first_cell = row * field_->cols();
  std::int32_t* dale = dale_.data() + first_cell;
  const std::int32_t* dale_above = dale - (row > 0 ? field_->cols() : 0);
  for (int i = 0; i < count; ++i) {
    const std::int32_t col = cols[i];
    if (dale[col] != kUnknown) continue;
    // the first steps of below(), where they lead to a cell whose dale is known
    const bool is_left_below = gaps[col - 1] <= gaps[col];
    const std::int32_t down_left = dale[std::max(col - 1, 0)];
    const std::int32_t down_above = gaps_above[col] <= gaps[col] ? dale_above[col] : kUnknown;
    const std::int32_t known = is_left_below ? down_left : down_above;
    if (known != kUnknown) {
      dale[col] = known;
    } else {
      follow({row, col, first_cell + col});
    }
  }
}

}  // namespace mems_stiction
