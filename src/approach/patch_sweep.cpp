#include "mems_stiction/approach/patch_sweep.hpp"

#include <algorithm>
#include <array>

namespace mems_stiction {
namespace {

struct Offset {
  int row;
  int col;
};

/// The four that share an edge first, then the diagonals.
constexpr std::array<Offset, 8> kNeighbours = {{{0, -1}, {0, 1}, {-1, 0}, {1, 0}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}}};
constexpr int kEdgeNeighbours = 4;

}  // namespace

void PatchSweep::begin(const GapField& field, const GapOrder& order, Connectivity connectivity) {
  field_ = &field;
  order_ = &order;
  connectivity_ = connectivity;
  label_.resize(static_cast<std::size_t>(field.cellCount()));
  restart();
}

void PatchSweep::restart() {
  inserted_ = 0;
  std::fill(label_.begin(), label_.end(), -1);
  parent_.clear();
  patches_.clear();
  live_.clear();
  live_place_.clear();
  changed_.clear();
  is_changed_.clear();
}

void PatchSweep::advanceTo(int count) {
  if (count < inserted_) restart();
  for (; inserted_ < count; ++inserted_) insert(order_->cells()[static_cast<std::size_t>(inserted_)].cell);
}

std::int32_t PatchSweep::root(std::int32_t id) {
  while (parent_[static_cast<std::size_t>(id)] != id) {
    std::int32_t& parent = parent_[static_cast<std::size_t>(id)];
    parent = parent_[static_cast<std::size_t>(parent)];  // path halving
    id = parent;
  }
  return id;
}

std::int32_t PatchSweep::patchOf(int cell) {
  const std::int32_t label = label_[static_cast<std::size_t>(cell)];
  return label < 0 ? -1 : root(label);
}

void PatchSweep::markChanged(std::int32_t id) {
  std::uint8_t& flag = is_changed_[static_cast<std::size_t>(id)];
  if (flag == 0) changed_.push_back(id);
  flag = 1;
}

const std::vector<std::int32_t>& PatchSweep::takeChangedPatches() {
  changed_live_.clear();
  for (const std::int32_t id : changed_) {
    is_changed_[static_cast<std::size_t>(id)] = 0;
    if (parent_[static_cast<std::size_t>(id)] == id) changed_live_.push_back(id);
  }
  changed_.clear();
  return changed_live_;
}

std::int32_t PatchSweep::addPatch(int cell) {
  const auto id = static_cast<std::int32_t>(patches_.size());
  patches_.push_back(ContactPatch::ofCell(*field_, cell));
  parent_.push_back(id);
  live_place_.push_back(static_cast<std::int32_t>(live_.size()));
  live_.push_back(id);
  is_changed_.push_back(0);
  return id;
}

std::int32_t PatchSweep::unite(std::int32_t a, std::int32_t b) {
  if (patches_[static_cast<std::size_t>(a)].area < patches_[static_cast<std::size_t>(b)].area) std::swap(a, b);
  patches_[static_cast<std::size_t>(a)].merge(*field_, patches_[static_cast<std::size_t>(b)]);
  parent_[static_cast<std::size_t>(b)] = a;
  const std::int32_t place = live_place_[static_cast<std::size_t>(b)];
  live_[static_cast<std::size_t>(place)] = live_.back();
  live_place_[static_cast<std::size_t>(live_.back())] = place;
  live_.pop_back();
  return a;
}

void PatchSweep::insert(int cell) {
  const int cols = field_->cols();
  const int rows = field_->rows();
  const int row = cell / cols;
  const int col = cell % cols;
  const std::size_t reach = connectivity_ == Connectivity::kEight ? kNeighbours.size() : kEdgeNeighbours;

  std::int32_t id = -1;
  for (std::size_t k = 0; k < reach; ++k) {
    const int neighbour_row = row + kNeighbours[k].row;
    const int neighbour_col = col + kNeighbours[k].col;
    if (neighbour_row < 0 || neighbour_row >= rows || neighbour_col < 0 || neighbour_col >= cols) continue;
    const std::int32_t neighbour_patch = patchOf(neighbour_row * cols + neighbour_col);
    if (neighbour_patch < 0 || neighbour_patch == id) continue;
    id = id < 0 ? neighbour_patch : unite(id, neighbour_patch);
  }
  if (id < 0) {
    id = addPatch(cell);
  } else {
    patches_[static_cast<std::size_t>(id)].merge(*field_, ContactPatch::ofCell(*field_, cell));
  }
  label_[static_cast<std::size_t>(cell)] = id;

  BoundarySums& boundary = patches_[static_cast<std::size_t>(id)].boundary;
  for (std::size_t k = 0; k < kEdgeNeighbours; ++k) {
    const int neighbour_row = row + kNeighbours[k].row;
    const int neighbour_col = col + kNeighbours[k].col;
    if (neighbour_row < 0 || neighbour_row >= rows || neighbour_col < 0 || neighbour_col >= cols) continue;
    const int neighbour = neighbour_row * cols + neighbour_col;
    if (!field_->isValid(neighbour)) continue;
    const bool was_outside = label_[static_cast<std::size_t>(neighbour)] < 0;
    boundary.addEdge(*field_, row, col, neighbour_row, neighbour_col, was_outside ? 1 : -1);
  }
  markChanged(id);
}

}  // namespace mems_stiction
