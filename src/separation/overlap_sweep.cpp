#include "mems_stiction/separation/overlap_sweep.hpp"

#include <algorithm>
#include <utility>

namespace mems_stiction {

void OverlapSweep::start(const GapField& field, Connectivity connectivity) {
  field_ = &field;
  connectivity_ = connectivity;
  const auto size = static_cast<std::size_t>(field.cellCount());
  if (patch_of_cell_.size() != size) {
    patch_of_cell_.assign(size, -1);
  } else {
    for (const std::int32_t cell : inserted_cells_) patch_of_cell_[static_cast<std::size_t>(cell)] = -1;
  }
  inserted_ = 0;
  inserted_cells_.clear();
  patches_.clear();
  parent_.clear();
  live_.clear();
  live_place_.clear();
}

int OverlapSweep::advanceTo(double approach, GapOrder& order) {
  if (!(approach > 0.0)) return inserted_;  // no gap is below 0
  const int count = order.sortBelow(approach);
  if (count > inserted_) {
    order.sortBetween(inserted_, count);
    while (inserted_ < count) insert(order.cells()[static_cast<std::size_t>(inserted_++)]);
  }
  return inserted_;
}

void OverlapSweep::insert(const OrderedCell& ordered) {
  std::int32_t id = -1;
  const GridCell cell = ordered.inGrid(field_->cols());
  const auto meet = [&](const GridCell& neighbour) {
    if (!field_->contains(neighbour)) return;
    const std::int32_t other = patch_of_cell_[static_cast<std::size_t>(neighbour.index)];
    if (other < 0) return;
    const std::int32_t root = rootOf(other);
    if (id < 0) {
      id = root;
    } else if (root != id) {
      id = unite(id, root, ordered.gap);
    }
  };
  for (const Side side : kSides) meet(cell.neighbour(side, field_->cols()));
  if (connectivity_ == Connectivity::kEight) {
    for (const Side vertical : {kTop, kBottom}) {
      const GridCell beside = cell.neighbour(vertical, field_->cols());
      for (const Side horizontal : {kLeft, kRight}) meet(beside.neighbour(horizontal, field_->cols()));
    }
  }
  if (id < 0) {
    id = static_cast<std::int32_t>(patches_.size());
    OverlapPatch patch;
    patch.summits = 1;
    patch.first_cell = cell.index;
    patch.first_gap = ordered.gap;
    patches_.push_back(patch);
    parent_.push_back(id);
    live_place_.push_back(static_cast<std::int32_t>(live_.size()));
    live_.push_back(id);
  }
  OverlapPatch& patch = patches_[static_cast<std::size_t>(id)];
  ++patch.cells;
  patch.gap_sum += ordered.gap;
  patch_of_cell_[static_cast<std::size_t>(cell.index)] = id;
  inserted_cells_.push_back(cell.index);
}

std::int32_t OverlapSweep::rootOf(std::int32_t id) {
  while (parent_[static_cast<std::size_t>(id)] != id) {
    std::int32_t& above = parent_[static_cast<std::size_t>(id)];
    above = parent_[static_cast<std::size_t>(above)];
    id = above;
  }
  return id;
}

std::int32_t OverlapSweep::unite(std::int32_t a, std::int32_t b, double gap) {
  const std::int32_t cells_a = patch(a).cells;
  const std::int32_t cells_b = patch(b).cells;
  if (cells_a < cells_b || (cells_a == cells_b && b < a)) std::swap(a, b);
  patches_[static_cast<std::size_t>(a)].merge(patch(b), gap);
  parent_[static_cast<std::size_t>(b)] = a;
  const std::int32_t place = live_place_[static_cast<std::size_t>(b)];
  live_[static_cast<std::size_t>(place)] = live_.back();
  live_place_[static_cast<std::size_t>(live_.back())] = place;
  live_.pop_back();
  return a;
}

}  // namespace mems_stiction
