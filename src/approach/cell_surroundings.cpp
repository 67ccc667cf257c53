#include "mems_stiction/approach/cell_surroundings.hpp"

#include <algorithm>

#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {
namespace {

/// Largest window, as a share of the frame: what a search up to a contact fraction of 0.3 reads in one go, at 12 bytes
/// a pixel of memory.
constexpr double kWindowShare = 0.31;
constexpr std::ptrdiff_t kWriteAhead = 3;

}  // namespace

void SurroundingsTable::start(const GapField& field, const GapOrder& order, DaleMap& dales) {
  field_ = &field;
  order_ = &order;
  dales_ = &dales;
  first_place_ = end_place_ = 0;
  for (std::vector<double>* gaps : {row_gaps_, row_gaps_ + 1, row_gaps_ + 2, &no_row_}) {
    gaps->assign(static_cast<std::size_t>(field.cols()) + 2, GapField::kInvalidGap);
  }
  for (std::vector<std::int32_t>& cells : row_cells_) cells.resize(static_cast<std::size_t>(field.cols()));
}

const CellSurroundings& SurroundingsTable::lookUp(const OrderedCell& ordered) {
  const GridCell cell = ordered.inGrid(field_->cols());
  for (const Side side : kSides) {
    const GridCell neighbour = cell.neighbour(side, field_->cols());
    looked_up_.gaps[side] = field_->contains(neighbour) ? field_->gap(neighbour.index) : GapField::kInvalidGap;
  }
  looked_up_.cell = cell.index;
  looked_up_.dale_and_border = static_cast<std::uint32_t>(dales_->find(cell)) << 1U | 1U;
  return looked_up_;
}

void SurroundingsTable::collectFrom(int place) {
  const auto capacity = static_cast<int>(kWindowShare * field_->cellCount());
  first_group_ = order_->groupOfPlace(place);
  first_place_ = order_->groupStart(first_group_);
  end_group_ = first_group_ + 1;
  while (end_group_ < order_->groupCount() && order_->groupStart(end_group_ + 1) - first_place_ <= capacity)
    ++end_group_;
  end_place_ = order_->groupStart(end_group_);
  if (end_place_ - first_place_ > capacity) {  // one group that is too large for the window: looked up cell by cell
    first_place_ = end_place_;
    return;
  }
  if (table_.capacity() < static_cast<std::size_t>(end_place_ - first_place_))
    table_.reserve(static_cast<std::size_t>(capacity));
  table_.resize(static_cast<std::size_t>(end_place_ - first_place_));
  next_place_.resize(static_cast<std::size_t>(end_group_ - first_group_));
  for (int group = first_group_; group < end_group_; ++group) {
    next_place_[static_cast<std::size_t>(group - first_group_)] = order_->groupStart(group) - first_place_;
  }
  int count = readRow(0, row_cells_[0]);
  for (int row = 0; row < field_->rows(); ++row) {
    // the dales of the next row first: a cell asks for those of its neighbours
    const int next_count = readRow(row + 1, row_cells_[(row + 1) % 2]);
    collectRow(row, row_cells_[row % 2], count);
    count = next_count;
  }
}

const double* SurroundingsTable::gapsOf(int row) const {
  const bool is_in_frame = row >= 0 && row < field_->rows();
  return (is_in_frame ? row_gaps_[row % kRowsKept] : no_row_).data() + 1;
}

int SurroundingsTable::readRow(int row, std::vector<std::int32_t>& cells) {
  if (row == field_->rows()) return 0;
  double* gaps = row_gaps_[row % kRowsKept].data() + 1;
  field_->gapsOfRow(row, gaps);
  const double limit = order_->groupLowerEnd(end_group_) + order_->bucketWidth();
  const int count = columnsBelow(limit, gaps, field_->cols(), cells.data());
  dales_->findInRow(row, cells.data(), count, gaps, gapsOf(row - 1));
  return count;
}

MEMS_STICTION_VECTORIZED void SurroundingsTable::collectRow(int row, const std::vector<std::int32_t>& cells,
                                                            int count) {
  const int cols = field_->cols();
  const int first_cell = row * cols;
  const double* line = gapsOf(row);
  const double* above = gapsOf(row - 1);
  const double* below = gapsOf(row + 1);
  const std::int32_t* dales = dales_->data() + first_cell;
  const std::int32_t* dales_above = row > 0 ? dales - cols : dales;
  const std::int32_t* dales_below = row + 1 < field_->rows() ? dales + cols : dales;
  const GapOrder& order = *order_;
  const auto groups = static_cast<std::uint32_t>(end_group_ - first_group_);
  for (int i = 0; i < count; ++i) {
    const std::int32_t col = cells[static_cast<std::size_t>(i)];
    const auto group = static_cast<std::uint32_t>(order.groupOf(line[col]) - first_group_);
    if (group >= groups) continue;
    CellSurroundings& around = table_[static_cast<std::size_t>(next_place_[group]++)];
    __builtin_prefetch(&around + kWriteAhead, 1);  // where the group goes on: there are too many for the processor
    around.gaps[kLeft] = line[col - 1];
    around.gaps[kRight] = line[col + 1];
    around.gaps[kTop] = above[col];
    around.gaps[kBottom] = below[col];
    around.cell = first_cell + col;
    const std::int32_t dale = dales[col];
    const std::int32_t dales_around[] = {dales[std::max(col - 1, 0)], dales[std::min(col + 1, cols - 1)],
                                         dales_above[col], dales_below[col]};
    std::uint32_t is_border = 0;
    for (const Side side : kSides) {  // only neighbours that come into contact before matter
      is_border |= static_cast<std::uint32_t>(comesFirst(side, around.gaps[side], line[col])) &
                   static_cast<std::uint32_t>(dales_around[side] != dale);
    }
    around.dale_and_border = static_cast<std::uint32_t>(dale) << 1U | is_border;
  }
}

}  // namespace mems_stiction
