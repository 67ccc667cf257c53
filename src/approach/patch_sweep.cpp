#include "mems_stiction/approach/patch_sweep.hpp"

#include <algorithm>

#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {
namespace {

/// How far ahead of the sweep memory is asked for: its order is random in the frame, but known.
constexpr int kPrefetchDistance = 16;
/// The first cells of a sweep, and the last ones that are past a window of the table, are looked up one by one if they
/// are no more than this share of the frame: most sweeps end before it, and a window costs a pass over the frame.
constexpr double kShareLookedUp = 1.0 / 64.0;

}  // namespace

void PatchSweep::begin(const GapField& field, const GapOrder& order, Connectivity connectivity) {
  field_ = &field;
  order_ = &order;
  connectivity_ = connectivity;
  dales_.begin(field);
  surroundings_.begin(field, order, dales_);
  restart();
}

void PatchSweep::restart() {
  inserted_ = 0;
  patch_of_dale_.clear();
  next_dale_.clear();
  dale_count_.clear();
  patches_.clear();
  live_.clear();
  live_place_.clear();
  changed_count_ = 0;
  is_changed_.clear();
  makeRoom();
}

void PatchSweep::makeRoom() {
  const auto count = static_cast<std::size_t>(dales_.count());
  patches_.resize(count);
  live_place_.resize(count);
  is_changed_.resize(count);
  changed_.resize(count + 1);
  dale_count_.resize(count, 1);
  for (auto id = static_cast<std::int32_t>(patch_of_dale_.size()); id < dales_.count(); ++id) {
    patch_of_dale_.push_back(id);
    next_dale_.push_back(id);
  }
}

// Inline: a function that only asks for memory has no effect that the compiler knows, and a call of it is left out.
MEMS_STICTION_INLINE void PatchSweep::prefetchCell(int place) const {
  const OrderedCell& cell = order_->cells()[static_cast<std::size_t>(place)];
  const std::int32_t* dale = dales_.data() + cell.cell;
  for (const std::ptrdiff_t offset : {-field_->cols(), 0, field_->cols()}) {
    __builtin_prefetch(dale + offset);
    field_->prefetch(cell.cell + offset);
  }
}

MEMS_STICTION_INLINE void PatchSweep::prefetchPatch(int place) const {
  const CellSurroundings& around = surroundings_.collected(place);
  const ContactPatch& patch = patches_[static_cast<std::size_t>(patchOfDale(around.dale()))];
  const char* lines = reinterpret_cast<const char*>(&patch);
  for (std::size_t offset = 0; offset < sizeof(ContactPatch); offset += kCacheLine)
    __builtin_prefetch(lines + offset, 1);
  if (!around.isBorder()) return;
  const std::int32_t* dale = dales_.data() + around.cell;
  for (const std::ptrdiff_t offset : {-field_->cols(), 0, field_->cols()}) __builtin_prefetch(dale + offset);
}

void PatchSweep::prefetchCentre(std::int32_t id) const {
  const ContactPatch& known = patch(id);
  const int row = (known.min_row + known.max_row) / 2;
  const int col = (known.min_col + known.max_col) / 2;
  const std::ptrdiff_t cell = static_cast<std::ptrdiff_t>(row) * field_->cols() + col;
  field_->prefetch(cell);
  __builtin_prefetch(dales_.data() + cell);
}

void PatchSweep::advanceTo(int count) {
  if (count < inserted_) restart();
  const auto looked_up = static_cast<int>(kShareLookedUp * field_->cellCount());
  while (inserted_ < count) {
    if (count > looked_up && order_->contactLimit() - inserted_ > looked_up && inserted_ >= surroundings_.end()) {
      surroundings_.collectFrom(inserted_);
      makeRoom();
    }
    if (inserted_ < surroundings_.begin()) {
      insertLookedUp(std::min(count, surroundings_.begin()));
    } else if (inserted_ < surroundings_.end()) {
      insertCollected(std::min(count, surroundings_.end()));
    } else {
      insertLookedUp(count);
    }
  }
}

MEMS_STICTION_INLINE void PatchSweep::markChanged(std::int32_t id) {
  std::int32_t& flag = is_changed_[static_cast<std::size_t>(id)];
  // written without a branch: there is room for every patch
  changed_[changed_count_] = id;
  changed_count_ += flag == 0 ? 1 : 0;
  flag = 1;
}

MEMS_STICTION_INLINE void PatchSweep::insert(const OrderedCell* const (&cells)[kLanes],
                                             const CellSurroundings* const (&around)[kLanes], int count) {
  const IntegerLanes index{cells[0]->cell, cells[1]->cell, cells[2]->cell, cells[3]->cell};
  const IntegerLanes row{cells[0]->row, cells[1]->row, cells[2]->row, cells[3]->row};
  const IntegerLanes col = index - row * field_->cols();
  const Lanes gap{cells[0]->gap, cells[1]->gap, cells[2]->gap, cells[3]->gap};
  Lanes neighbours[4];
  load(around[0]->gaps, neighbours[0]);
  load(around[1]->gaps, neighbours[1]);
  load(around[2]->gaps, neighbours[2]);
  load(around[3]->gaps, neighbours[3]);
  transpose(neighbours[0], neighbours[1], neighbours[2], neighbours[3]);
  const Lanes row_lanes = __builtin_convertvector(row, Lanes);
  const Lanes col_lanes = __builtin_convertvector(col, Lanes);
  const EdgeChanges changes(gap, neighbours, col_lanes, row_lanes);

  for (int lane = 0; lane < count; ++lane) {
    const CellSurroundings& surroundings = *around[lane];
    std::int32_t id = patchOfDale(surroundings.dale());
    if (surroundings.isBorder() || connectivity_ == Connectivity::kEight) id = join(id, *cells[lane], surroundings);
    ContactPatch& patch = patches_[static_cast<std::size_t>(id)];
    if (patch.area == 0) {
      live_place_[static_cast<std::size_t>(id)] = static_cast<std::int32_t>(live_.size());
      live_.push_back(id);
    }
    const GridCell cell{row[lane], col[lane], index[lane]};
    patch.addCell(cell, cells[lane]->gap, surroundings.gaps);
    patch.boundary.addEdges(changes, static_cast<std::size_t>(lane));
    if (!field_->upperIsFlat()) {
      patch.boundary.addLowerEdges(*field_, cell, changes, static_cast<std::size_t>(lane));
    }
    markChanged(id);
  }
  inserted_ += count;
}

void PatchSweep::insertLookedUp(int stop) {
  const auto ahead_end = static_cast<int>(order_->cells().size()) - kPrefetchDistance;
  CellSurroundings looked_up[kLanes];
  while (inserted_ < stop) {
    const int count = std::min(stop - inserted_, static_cast<int>(kLanes));
    const OrderedCell* next = order_->cells().data() + inserted_;
    for (int i = 0; i < count; ++i) {
      if (inserted_ + i < ahead_end) prefetchCell(inserted_ + i + kPrefetchDistance);
      looked_up[i] = surroundings_.look(gridCell(next[i]));
    }
    if (dales_.count() > patchIdEnd()) makeRoom();
    const int last = count - 1;
    const int used[kLanes] = {0, std::min(1, last), std::min(2, last), last};
    insert({next, next + used[1], next + used[2], next + used[3]},
           {looked_up, looked_up + used[1], looked_up + used[2], looked_up + used[3]}, count);
  }
}

MEMS_STICTION_VECTORIZED void PatchSweep::insertCollected(int stop) {
  constexpr int kCount = kLanes;
  const int ahead_end = stop - kPrefetchDistance - kCount;
  while (inserted_ + kCount <= stop) {
    if (inserted_ < ahead_end) {
      for (int i = 0; i < kCount; ++i) prefetchPatch(inserted_ + i + kPrefetchDistance);
    }
    const OrderedCell* next = order_->cells().data() + inserted_;
    const CellSurroundings* around = &surroundings_.collected(inserted_);
    const auto isCollected = [&](int i) { return static_cast<int>(around[i].cell == next[i].cell); };
    const int are_collected = isCollected(0) & isCollected(1) & isCollected(2) & isCollected(3);
    if (are_collected == 0) {  // their group has been sorted since
      insertLookedUp(inserted_ + kCount);
      continue;
    }
    insert({next, next + 1, next + 2, next + 3}, {around, around + 1, around + 2, around + 3}, kCount);
  }
  insertLookedUp(stop);
}

std::int32_t PatchSweep::patchOf(const GridCell& cell) {
  const std::int32_t dale = dales_.at(cell);
  if (dale < 0 || dale >= patchIdEnd()) return -1;
  const std::int32_t id = patchOfDale(dale);
  const ContactPatch& patch = patches_[static_cast<std::size_t>(id)];
  return patch.area > 0 && field_->gap(cell.index) <= patch.latest_gap ? id : -1;
}

const std::vector<std::int32_t>& PatchSweep::takeChangedPatches() {
  changed_live_.clear();
  for (std::size_t i = 0; i < changed_count_; ++i) {
    const std::int32_t id = changed_[i];
    is_changed_[static_cast<std::size_t>(id)] = 0;
    if (patchOfDale(id) == id) changed_live_.push_back(id);
  }
  changed_count_ = 0;
  return changed_live_;
}

std::int32_t PatchSweep::unite(std::int32_t a, std::int32_t b) {
  if (dale_count_[static_cast<std::size_t>(a)] < dale_count_[static_cast<std::size_t>(b)]) std::swap(a, b);
  dale_count_[static_cast<std::size_t>(a)] += dale_count_[static_cast<std::size_t>(b)];
  std::int32_t dale = b;
  do {
    patch_of_dale_[static_cast<std::size_t>(dale)] = a;
    dale = next_dale_[static_cast<std::size_t>(dale)];
  } while (dale != b);
  std::swap(next_dale_[static_cast<std::size_t>(a)], next_dale_[static_cast<std::size_t>(b)]);

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

std::int32_t PatchSweep::join(std::int32_t id, const OrderedCell& ordered, const CellSurroundings& around) {
  const int cols = field_->cols();
  const int col = ordered.cell - ordered.row * cols;
  const auto joinNeighbour = [&](int row_step, int col_step, double gap) {
    const GridCell neighbour{ordered.row + row_step, col + col_step, ordered.cell + row_step * cols + col_step};
    if (!comesBefore(gap, neighbour.index, ordered.gap, ordered.cell)) return;
    const std::int32_t dale = dales_.find(neighbour);
    if (dale >= patchIdEnd()) makeRoom();
    const std::int32_t neighbour_id = patchOfDale(dale);
    if (neighbour_id != id) id = unite(id, neighbour_id);
  };
  joinNeighbour(0, -1, around.gaps[kLeft]);
  joinNeighbour(0, 1, around.gaps[kRight]);
  joinNeighbour(-1, 0, around.gaps[kTop]);
  joinNeighbour(1, 0, around.gaps[kBottom]);
  if (connectivity_ == Connectivity::kFour) return id;
  for (const int row_step : {-1, 1}) {
    for (const int col_step : {-1, 1}) {
      const int row = ordered.row + row_step;
      if (row < 0 || row >= field_->rows() || col + col_step < 0 || col + col_step >= cols) continue;
      joinNeighbour(row_step, col_step, field_->gap(row * cols + col + col_step));
    }
  }
  return id;
}

}  // namespace mems_stiction
