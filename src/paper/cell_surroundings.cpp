#include "paper/cell_surroundings.hpp"

#include <algorithm>

#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

/// Largest window, as a share of the frame: what a search up to a contact fraction of 0.3 reads in
/// one go, at 12 bytes a pixel of memory.
constexpr double kWindowShare = 0.31;
constexpr std::ptrdiff_t kWriteAhead = 3;

}  // namespace

void SurroundingsTable::start(const GapField& field, const GapOrder& order, DaleMap& dales) {
  field_ = &field;
  order_ = &order;
  dales_ = &dales;
  first_place_ = end_place_ = 0;
}

const CellSurroundings& SurroundingsTable::lookUp(const OrderedCell& ordered) {
  const GridCell cell = field_->cellAt(ordered.cell);
  for (const Side side : kSides) {
    const GridCell neighbour = cell.neighbour(side, field_->cols());
    looked_up_.gaps[side] =
        field_->contains(neighbour) ? field_->gap(neighbour.index) : GapField::kInvalidGap;
  }
  looked_up_.cell = cell.index;
  looked_up_.tag = DaleTag(dales_->find(cell), DaleTag::kAllSides);
  return looked_up_;
}

void SurroundingsTable::collectFrom(int place) {
  const auto capacity = static_cast<int>(kWindowShare * field_->cellCount());
  first_group_ = order_->groupOfPlace(place);
  first_place_ = order_->groupStart(first_group_);
  end_group_ = first_group_ + 1;
  while (end_group_ < order_->groupCount() &&
         order_->groupStart(end_group_ + 1) - first_place_ <= capacity)
    ++end_group_;
  end_place_ = order_->groupStart(end_group_);
  if (end_place_ - first_place_ >
      capacity) {  // one group that is too large for the window: looked up cell by cell
    first_place_ = end_place_;
    return;
  }
  if (table_.capacity() < static_cast<std::size_t>(end_place_ - first_place_))
    table_.reserve(static_cast<std::size_t>(capacity));
  table_.resize(static_cast<std::size_t>(end_place_ - first_place_));
  next_place_.resize(static_cast<std::size_t>(end_group_ - first_group_));
  for (int group = first_group_; group < end_group_; ++group) {
    next_place_[static_cast<std::size_t>(group - first_group_)] =
        order_->groupStart(group) - first_place_;
  }
  const double margin =
      order_->bucketWidth();  // where groups begin and end is a matter of rounding
  rows_.start(*field_, *dales_, order_->groupLowerEnd(first_group_) - margin,
              order_->groupLowerEnd(end_group_) + margin);
  while (rows_.next()) collectRow();
}

MEMS_STICTION_VECTORIZED void SurroundingsTable::collectRow() {
  const RowsAround rows = rows_.around();
  const std::int32_t* columns = rows_.columns();
  const int count = rows_.count();
  const int first_cell = rows_.row() * field_->cols();
  const GapOrder& order = *order_;
  const auto groups = static_cast<std::uint32_t>(end_group_ - first_group_);
  for (int i = 0; i < count; ++i) {
    const std::int32_t col = columns[i];
    const auto group = static_cast<std::uint32_t>(order.groupOf(rows.gaps[col]) - first_group_);
    if (group >= groups) continue;
    CellSurroundings& around = table_[static_cast<std::size_t>(next_place_[group]++)];
    __builtin_prefetch(&around + kWriteAhead,
                       1);  // where the group goes on: there are too many for the processor
    around.gaps[kLeft] = rows.gaps[col - 1];
    around.gaps[kRight] = rows.gaps[col + 1];
    around.gaps[kTop] = rows.above[col];
    around.gaps[kBottom] = rows.below[col];
    around.cell = first_cell + col;
    around.tag = rows.tagOf(col);
  }
}

}  // namespace mems_stiction
