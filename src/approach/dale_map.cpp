#include "mems_stiction/approach/dale_map.hpp"

namespace mems_stiction {

void DaleMap::begin(const GapField& field) {
  field_ = &field;
  count_ = 0;
  dale_.assign(static_cast<std::size_t>(field.cellCount()), kUnknown);
}

GridCell DaleMap::below(const GridCell& cell) const {
  const double* gap = field_->gaps().data() + cell.index;
  const int cols = field_->cols();
  // of equal gaps the smaller index comes first
  if (cell.col > 0 && gap[-1] <= *gap) return {cell.row, cell.col - 1, cell.index - 1};
  if (cell.row > 0 && gap[-cols] <= *gap) return {cell.row - 1, cell.col, cell.index - cols};
  const double right = cell.col + 1 < cols ? gap[1] : GapField::kInvalidGap;
  const double bottom = cell.row + 1 < field_->rows() ? gap[cols] : GapField::kInvalidGap;
  if (right < *gap && right <= bottom) return {cell.row, cell.col + 1, cell.index + 1};
  if (bottom < *gap) return {cell.row + 1, cell.col, cell.index + cols};
  return cell;
}

std::int32_t DaleMap::follow(const GridCell& start) {
  GridCell cell = start;
  while (at(cell) == kUnknown) {
    const GridCell next = below(cell);
    if (next.index == cell.index) dale_[place(cell)] = count_++;
    cell = next;
  }
  const std::int32_t dale = at(cell);
  for (cell = start; at(cell) != dale; cell = below(cell)) dale_[place(cell)] = dale;
  return dale;
}

void DaleMap::findInRow(int row, const std::int32_t* cols, int count) {
  const int first_cell = row * field_->cols();
  const double* gap = field_->gaps().data() + first_cell;
  const double* above = gap - (row > 0 ? field_->cols() : 0);
  std::int32_t* dale = dale_.data() + first_cell;
  const std::int32_t* dale_above = dale - (row > 0 ? field_->cols() : 0);
  for (int i = 0; i < count; ++i) {
    const std::int32_t col = cols[i];
    if (dale[col] != kUnknown) continue;
    // the first steps of below(), where they lead to a cell whose dale is known
    const std::int32_t left = col > 0 ? col - 1 : col;
    const std::int32_t down_left = gap[left] <= gap[col] ? dale[left] : kUnknown;
    const std::int32_t down_above = above[col] <= gap[col] ? dale_above[col] : kUnknown;
    const std::int32_t known = gap[left] <= gap[col] && left < col ? down_left : down_above;
    if (known != kUnknown) {
      dale[col] = known;
    } else {
      follow({row, col, first_cell + col});
    }
  }
}

}  // namespace mems_stiction
