#include "mems_stiction/approach/patch_sweep.hpp"

#include <algorithm>

namespace mems_stiction {
namespace {

constexpr std::int32_t kApart = -1;
/// Invalid cells and the border around the frame.
constexpr std::int32_t kNoCell = -2;
/// How far ahead of the sweep memory is asked for: its order is random in the frame, but known.
constexpr int kPrefetchDistance = 16;
/// The patches that a cell will join are known once its neighbours' labels have arrived.
constexpr int kPatchPrefetchDistance = 6;
constexpr std::size_t kCacheLine = 64;

}  // namespace

std::size_t PatchSweep::placeOf(std::int32_t cell, std::int32_t row) const {
  return static_cast<std::size_t>(cell + stride_ + 1 + 2 * row);
}

void PatchSweep::begin(const GapField& field, const GapOrder& order, Connectivity connectivity) {
  field_ = &field;
  order_ = &order;
  connectivity_ = connectivity;
  stride_ = field.cols() + 2;
  label_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(field.rows() + 2), kNoCell);
  for (int row = 0; row < field.rows(); ++row) {
    std::fill_n(label_.data() + placeOf(row * field.cols(), row), field.cols(), kApart);
  }
  if (field.validCount() < field.cellCount()) {
    for (int cell = 0; cell < field.cellCount(); ++cell) {
      if (!field.isValid(cell)) label_[placeOf(cell, cell / field.cols())] = kNoCell;
    }
  }
  inserted_ = 0;
  restart();
}

void PatchSweep::restart() {
  for (int i = 0; i < inserted_; ++i) {
    const OrderedCell& cell = order_->cells()[static_cast<std::size_t>(i)];
    label_[placeOf(cell.cell, cell.row)] = kApart;
  }
  inserted_ = 0;
  parent_.clear();
  patches_.clear();
  live_.clear();
  live_place_.clear();
  changed_.clear();
  is_changed_.clear();
}

void PatchSweep::prefetch(const OrderedCell& cell) const {
  const std::int32_t* label = label_.data() + placeOf(cell.cell, cell.row);
  __builtin_prefetch(label - stride_);
  __builtin_prefetch(label, 1);
  __builtin_prefetch(label + stride_);
  const double* gap = field_->gaps().data() + cell.cell;
  __builtin_prefetch(gap - field_->cols());
  __builtin_prefetch(gap);
  __builtin_prefetch(gap + field_->cols());
}

void PatchSweep::prefetchPatches(const OrderedCell& cell) const {
  const std::int32_t* label = label_.data() + placeOf(cell.cell, cell.row);
  std::int32_t last = kApart;
  for (const std::int32_t neighbour : {label[-1], label[1], *(label - stride_), label[stride_]}) {
    if (neighbour < 0 || neighbour == last) continue;
    last = neighbour;
    const char* patch = reinterpret_cast<const char*>(patches_.data() + neighbour);
    for (std::size_t offset = 0; offset < sizeof(ContactPatch); offset += kCacheLine)
      __builtin_prefetch(patch + offset, 1);
    __builtin_prefetch(parent_.data() + neighbour);
  }
}

void PatchSweep::advanceTo(int count) {
  if (count < inserted_) restart();
  const std::vector<OrderedCell>& cells = order_->cells();
  const auto ahead_end = static_cast<int>(cells.size()) - kPrefetchDistance;
  const int patch_ahead_end = count - kPatchPrefetchDistance;
  for (; inserted_ < count; ++inserted_) {
    if (inserted_ < ahead_end) prefetch(cells[static_cast<std::size_t>(inserted_ + kPrefetchDistance)]);
    if (inserted_ < patch_ahead_end)
      prefetchPatches(cells[static_cast<std::size_t>(inserted_ + kPatchPrefetchDistance)]);
    insert(cells[static_cast<std::size_t>(inserted_)]);
  }
}

std::int32_t PatchSweep::root(std::int32_t id) {
  while (parent_[static_cast<std::size_t>(id)] != id) {
    std::int32_t& parent = parent_[static_cast<std::size_t>(id)];
    parent = parent_[static_cast<std::size_t>(parent)];  // path halving
    id = parent;
  }
  return id;
}

std::int32_t PatchSweep::patchOf(const GridCell& cell) {
  const std::int32_t label = label_[placeOf(cell.index, cell.row)];
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

std::int32_t PatchSweep::addPatch(const ContactPatch& patch) {
  const auto id = static_cast<std::int32_t>(patches_.size());
  patches_.push_back(patch);
  parent_.push_back(id);
  live_place_.push_back(static_cast<std::int32_t>(live_.size()));
  live_.push_back(id);
  is_changed_.push_back(0);
  return id;
}

std::int32_t PatchSweep::unite(std::int32_t a, std::int32_t b) {
  if (patches_[static_cast<std::size_t>(a)].area < patches_[static_cast<std::size_t>(b)].area) std::swap(a, b);
  patches_[static_cast<std::size_t>(a)].merge(patches_[static_cast<std::size_t>(b)]);
  parent_[static_cast<std::size_t>(b)] = a;
  const std::int32_t place = live_place_[static_cast<std::size_t>(b)];
  live_[static_cast<std::size_t>(place)] = live_.back();
  live_place_[static_cast<std::size_t>(live_.back())] = place;
  live_.pop_back();
  if (place < static_cast<std::int32_t>(live_.size())) markChanged(live_[static_cast<std::size_t>(place)]);
  return a;
}

std::int32_t PatchSweep::joined(std::int32_t id, std::int32_t label) {
  if (label < 0 || label == id) return id;
  const std::int32_t neighbour = root(label);
  if (id < 0) return neighbour;
  return neighbour == id ? id : unite(id, neighbour);
}

void PatchSweep::insert(const OrderedCell& ordered) {
  const GridCell cell{ordered.row, ordered.cell - ordered.row * field_->cols(), ordered.cell};
  std::int32_t* const label = label_.data() + placeOf(ordered.cell, ordered.row);
  const std::int32_t labels[4] = {label[-1], label[1], *(label - stride_), label[stride_]};  // in the order of Side
  const int neighbours[4] = {cell.index - 1, cell.index + 1, cell.index - field_->cols(), cell.index + field_->cols()};

  std::int32_t id = -1;
  double gaps[4];
  double signs[4];
  for (int side = 0; side < 4; ++side) {
    gaps[side] = labels[side] == kNoCell ? GapField::kInvalidGap : field_->gap(neighbours[side]);
    // an edge to a cell in contact was counted from its other side, and is inside now
    signs[side] = labels[side] >= 0 ? -1.0 : (labels[side] == kApart ? 1.0 : 0.0);
    id = joined(id, labels[side]);
  }
  if (connectivity_ == Connectivity::kEight) {
    for (const std::ptrdiff_t diagonal : {-stride_ - 1, 1 - stride_, stride_ - 1, stride_ + 1}) {
      id = joined(id, label[diagonal]);
    }
  }
  if (id < 0) {
    id = addPatch(ContactPatch::ofCell(cell, ordered.gap, gaps));
  } else {
    patches_[static_cast<std::size_t>(id)].addCell(cell, ordered.gap, gaps);
  }
  *label = id;
  patches_[static_cast<std::size_t>(id)].boundary.addEdges(*field_, cell, ordered.gap, gaps, signs);
  markChanged(id);
}

}  // namespace mems_stiction
