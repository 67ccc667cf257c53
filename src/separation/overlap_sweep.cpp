#include "separation/overlap_sweep.hpp"

#include <algorithm>
#include <utility>

namespace mems_stiction {
namespace {

/// More patches than this do not lie in the cache: they are asked for some cells ahead.
constexpr std::size_t kPatchesInCache = 1 << 14;
constexpr int kCellsAhead = 16;

}  // namespace

void OverlapSweep::start(const GapField& field, DaleMap& dales, Connectivity connectivity) {
  field_ = &field;
  dales_ = &dales;
  connectivity_ = connectivity;
  inserted_ = 0;
  approach_ = 0.0;
  joined_.clear();
  patches_.clear();
  live_.clear();
  live_place_.clear();
  has_meeting_.clear();
}

int OverlapSweep::advanceTo(double approach, GapOrder& order, const OverlapSweep* ahead) {
  if (!(approach > approach_)) return inserted_;  // no gap is below 0
  approach_ = approach;
  const int count = order.sortBelow(approach);
  if (count == inserted_) return inserted_;
  const auto dale_count = static_cast<std::size_t>(dales_->count());
  joined_.growTo(dales_->count());
  live_place_.resize(dale_count, kNone);
  has_meeting_.resize(static_cast<std::size_t>(order.groupCount()));
  for (int group = order.groupOfPlace(inserted_); inserted_ < count; ++group) {
    const int end = std::min(count, order.groupStart(group + 1));
    const OrderedCell* const cells = order.cells().data();
    if (dale_count > kPatchesInCache) {
      for (int place = inserted_; place < end; ++place) {
        const OrderedCell& later = cells[std::min(place + kCellsAhead, count - 1)];
        const std::int32_t its_place = livePlace(patchOf(later));
        if (its_place != kNone)
          __builtin_prefetch(&patches_[static_cast<std::size_t>(its_place)], 1);
      }
    }
    // the same cells in the same order meet in the same places
    const bool is_known = ahead != nullptr && ahead->inserted_ >= end;
    const bool has_meeting = is_known ? ahead->has_meeting_[static_cast<std::size_t>(group)] != 0
                                      : patchesMeetBefore(end, order);
    if (has_meeting) {
      has_meeting_[static_cast<std::size_t>(group)] = 1;
      order.sortBetween(inserted_, end);
      for (; inserted_ < end; ++inserted_) {
        const OrderedCell& ordered = cells[inserted_];
        insert(join(patchOf(ordered), ordered), ordered);
      }
    } else {
      for (; inserted_ < end; ++inserted_) insert(patchOf(cells[inserted_]), cells[inserted_]);
    }
  }
  return inserted_;
}

bool OverlapSweep::patchesMeetBefore(int end, const GapOrder& order) const {
  if (connectivity_ == Connectivity::kEight) return true;  // a tag knows nothing of corners
  const OrderedCell* const cells = order.cells().data();
  const int cols = field_->cols();
  const int steps[] = {-1, 1, -cols, cols};
  const std::int32_t* const dales = dales_->data();
  for (int place = inserted_; place < end; ++place) {
    const OrderedCell& ordered = cells[place];
    if (!ordered.tag.isBorder()) continue;
    const std::int32_t id = patchOf(ordered);
    for (const Side side : kSides) {
      if (ordered.tag.isBorderAt(side) && joined_.patchOf(dales[ordered.cell + steps[side]]) != id)
        return true;
    }
  }
  return false;
}

void OverlapSweep::insert(std::int32_t id, const OrderedCell& ordered) {
  std::int32_t& place = live_place_[static_cast<std::size_t>(id)];
  if (place == kNone) {
    place = static_cast<std::int32_t>(live_.size());
    live_.push_back(id);
    patches_.push_back({1, 1, ordered.cell, ordered.gap, ordered.gap, 0.0});
    return;
  }
  OverlapPatch& patch = patches_[static_cast<std::size_t>(place)];
  if (comesBefore(ordered.gap, ordered.cell, patch.first_gap, patch.first_cell)) {
    patch.first_cell = ordered.cell;  // of the same group
    patch.first_gap = ordered.gap;
  }
  ++patch.cells;
  patch.gap_sum += ordered.gap;
}

std::int32_t OverlapSweep::patchOf(const GridCell& cell) {
  if (!(field_->gap(cell.index) < approach_)) return -1;
  return joined_.patchOf(dales_->find(cell));
}

std::int32_t OverlapSweep::join(std::int32_t id, const OrderedCell& ordered) {
  const int cols = field_->cols();
  const auto meet = [&](const GridCell& neighbour) {
    const std::int32_t other = joined_.patchOf(dales_->find(neighbour));
    if (other != id) id = unite(id, other, ordered.gap);
  };
  const GridCell cell = field_->cellAt(ordered.cell);
  for (const Side side : kSides) {
    if (ordered.tag.isBorderAt(side)) meet(cell.neighbour(side, cols));
  }
  if (connectivity_ == Connectivity::kEight) {
    for (const Side vertical : {kTop, kBottom}) {
      const GridCell beside = cell.neighbour(vertical, cols);
      for (const Side horizontal : {kLeft, kRight}) {
        const GridCell corner = beside.neighbour(horizontal, cols);
        if (!field_->contains(corner)) continue;
        if (comesBefore(field_->gap(corner.index), corner.index, ordered.gap, ordered.cell))
          meet(corner);
      }
    }
  }
  return id;
}

std::int32_t OverlapSweep::unite(std::int32_t a, std::int32_t b, double gap) {
  if (joined_.unite(a, b) != a) std::swap(a, b);
  const std::int32_t place = livePlace(b);
  if (place == kNone) return a;  // a dale whose first cell touches another's at a corner
  const std::int32_t surviving_place = livePlace(a);
  if (surviving_place == kNone) {
    live_[static_cast<std::size_t>(place)] = a;
    live_place_[static_cast<std::size_t>(a)] = place;
    return a;
  }
  patches_[static_cast<std::size_t>(surviving_place)].merge(
      patches_[static_cast<std::size_t>(place)], gap);
  live_[static_cast<std::size_t>(place)] = live_.back();
  patches_[static_cast<std::size_t>(place)] = patches_.back();
  live_place_[static_cast<std::size_t>(live_.back())] = place;
  live_.pop_back();
  patches_.pop_back();
  return a;
}

}  // namespace mems_stiction
