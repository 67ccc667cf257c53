#include "approach/dale_map.hpp"

#include <algorithm>

namespace mems_stiction {

void DaleMap::start(const GapField& field) {
  field_ = &field;
  count_ = 0;
  dale_.assign(static_cast<std::size_t>(field.cellCount()), kUnknown);
}

template <typename Scalar>
GridCell DaleMap::below(const GridCell& cell, const StoredGaps<Scalar>& gaps) const {
  const int cols = field_->cols();
  const double gap = gaps[cell.index];
  const GridCell left = cell.neighbour(kLeft, cols);
  const GridCell top = cell.neighbour(kTop, cols);
  if (cell.col > 0 && comesFirst(kLeft, gaps[left.index], gap)) return left;
  if (cell.row > 0 && comesFirst(kTop, gaps[top.index], gap)) return top;
  const GridCell right = cell.neighbour(kRight, cols);
  const GridCell bottom = cell.neighbour(kBottom, cols);
  const double right_gap = cell.col + 1 < cols ? gaps[right.index] : GapField::kInvalidGap;
  const double bottom_gap =
      cell.row + 1 < field_->rows() ? gaps[bottom.index] : GapField::kInvalidGap;
  const bool right_is_lower = !comesBefore(bottom_gap, bottom.index, right_gap, right.index);
  if (right_is_lower && comesFirst(kRight, right_gap, gap)) return right;
  return comesFirst(kBottom, bottom_gap, gap) ? bottom : cell;
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

void DaleMap::findInRow(int row, const std::int32_t* cols, int count, const double* gaps,
                        const double* gaps_above) {
  const int first_cell = row * field_->cols();
  std::int32_t* dale = dale_.data() + first_cell;
  const std::int32_t* dale_above = dale - (row > 0 ? field_->cols() : 0);
  for (int i = 0; i < count; ++i) {
    const std::int32_t col = cols[i];
    if (dale[col] != kUnknown) continue;
    // the first steps of below(), where they lead to a cell whose dale is known
    const std::int32_t left = dale[std::max(col - 1, 0)];
    const std::int32_t top =
        comesFirst(kTop, gaps_above[col], gaps[col]) ? dale_above[col] : kUnknown;
    const std::int32_t known = comesFirst(kLeft, gaps[col - 1], gaps[col]) ? left : top;
    if (known != kUnknown) {
      dale[col] = known;
    } else {
      follow({row, col, first_cell + col});
    }
  }
}

}  // namespace mems_stiction
