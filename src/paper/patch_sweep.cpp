#include "paper/patch_sweep.hpp"

#include <algorithm>

namespace mems_stiction {
namespace {

/// The first cells of a sweep, and the last ones that are past a window of the table, are looked up
/// one by one if they are no more than this share of the frame: most sweeps end before it, and a
/// window costs a pass over the frame.
constexpr double kShareLookedUp = 1.0 / 64.0;
/// Cells of the order lie all over the frame: heights are asked for so many cells before they are
/// needed.
constexpr int kCellsAhead = 12;

}  // namespace

void PatchSweep::start(const GapField& field, const GapOrder& order, Connectivity connectivity) {
  field_ = &field;
  order_ = &order;
  connectivity_ = connectivity;
  dales_.start(field);
  surroundings_.start(field, order, dales_);
  restart();
}

void PatchSweep::restart() {
  inserted_ = 0;
  joined_.clear();
  patches_.clear();
  live_.clear();
  live_place_.clear();
  changed_.clear();
  is_changed_.clear();
  makeRoom();
}

void PatchSweep::makeRoom() {
  const auto count = static_cast<std::size_t>(dales_.count());
  patches_.resize(count);
  live_place_.resize(count);
  is_changed_.resize(count);
  joined_.growTo(dales_.count());
}

void PatchSweep::advanceTo(int count) {
  if (count < inserted_) restart();
  const auto looked_up = static_cast<int>(kShareLookedUp * field_->cellCount());
  while (inserted_ < count) {
    const bool is_past_window = inserted_ >= surroundings_.endPlace();
    if (is_past_window && count > looked_up && order_->contactLimit() - inserted_ > looked_up) {
      surroundings_.collectFrom(inserted_);
    }
    const auto ahead = static_cast<std::size_t>(std::min(inserted_ + kCellsAhead, count - 1));
    field_->prefetchLower(order_->cells()[ahead].cell);
    insertNext();
  }
}

void PatchSweep::markChanged(std::int32_t id) {
  std::uint8_t& is_changed = is_changed_[static_cast<std::size_t>(id)];
  if (is_changed == 0) changed_.push_back(id);
  is_changed = 1;
}

void PatchSweep::insertNext() {
  const OrderedCell& ordered = order_->cells()[static_cast<std::size_t>(inserted_)];
  const CellSurroundings& around = surroundings_.at(inserted_);
  if (dales_.count() > patchIdEnd()) makeRoom();
  const GridCell cell = field_->cellAt(ordered.cell);
  std::int32_t id = joined_.patchOf(around.dale());
  if (around.isBorder() || connectivity_ == Connectivity::kEight)
    id = join(id, cell, ordered.gap, around);
  ContactPatch& patch = patches_[static_cast<std::size_t>(id)];
  if (patch.area == 0) {
    live_place_[static_cast<std::size_t>(id)] = static_cast<std::int32_t>(live_.size());
    live_.push_back(id);
  }
  patch.addCell(cell, ordered.gap, around.gaps);
  patch.boundary.addEdges(cell, ordered.gap, around.gaps);
  if (!field_->upperIsFlat()) patch.boundary.addLowerEdges(*field_, cell, ordered.gap, around.gaps);
  markChanged(id);
  ++inserted_;
}

std::int32_t PatchSweep::patchOf(const GridCell& cell) {
  const std::int32_t dale = dales_.at(cell);
  if (dale < 0 || dale >= patchIdEnd()) return -1;
  const std::int32_t id = joined_.patchOf(dale);
  const ContactPatch& patch = patches_[static_cast<std::size_t>(id)];
  return patch.area > 0 && field_->gap(cell.index) <= patch.latest_gap ? id : -1;
}

const std::vector<std::int32_t>& PatchSweep::takeChangedPatches() {
  changed_live_.clear();
  for (const std::int32_t id : changed_) {
    is_changed_[static_cast<std::size_t>(id)] = 0;
    if (joined_.patchOf(id) == id) changed_live_.push_back(id);
  }
  changed_.clear();
  return changed_live_;
}

std::int32_t PatchSweep::unite(std::int32_t a, std::int32_t b) {
  if (joined_.unite(a, b) != a) std::swap(a, b);

  ContactPatch& patch = patches_[static_cast<std::size_t>(a)];
  const ContactPatch& other = patches_[static_cast<std::size_t>(b)];
  if (other.area == 0) return a;  // its cells of this step are still to come
  const std::int32_t place = live_place_[static_cast<std::size_t>(b)];
  std::int32_t moved = a;
  if (patch.area == 0) {
    patch = other;
  } else {
    patch.merge(other);
    moved = live_.back();
    live_.pop_back();
  }
  if (place < static_cast<std::int32_t>(live_.size())) {
    live_[static_cast<std::size_t>(place)] = moved;
    live_place_[static_cast<std::size_t>(moved)] = place;
    markChanged(moved);
  }
  return a;
}

std::int32_t PatchSweep::join(std::int32_t id, const GridCell& cell, double gap,
                              const CellSurroundings& around) {
  const auto joinNeighbour = [&](const GridCell& neighbour) {
    const std::int32_t dale = dales_.find(neighbour);
    if (dale >= patchIdEnd()) makeRoom();
    const std::int32_t neighbour_id = joined_.patchOf(dale);
    if (neighbour_id != id) id = unite(id, neighbour_id);
  };
  const int cols = field_->cols();
  for (const Side side : kSides) {
    if (comesFirst(side, around.gaps[side], gap)) joinNeighbour(cell.neighbour(side, cols));
  }
  if (connectivity_ == Connectivity::kFour) return id;
  for (const Side vertical : {kTop, kBottom}) {
    for (const Side horizontal : {kLeft, kRight}) {
      const GridCell corner = cell.neighbour(vertical, cols).neighbour(horizontal, cols);
      if (!field_->contains(corner)) continue;
      if (comesBefore(field_->gap(corner.index), corner.index, gap, cell.index))
        joinNeighbour(corner);
    }
  }
  return id;
}

}  // namespace mems_stiction
