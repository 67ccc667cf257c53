#include "half_space/revertible_displacement.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "half_space/row_work.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// values + share of the last change, which is the first part of this one.
MEMS_STICTION_VECTORIZED void addShare(std::size_t count, float share, const float* last_change,
                                       double* values, float* change) {
  for (std::size_t i = 0; i < count; ++i) {
    const float move = share * last_change[i];
    change[i] = move;
    values[i] += static_cast<double>(move);
  }
}

/// values + length step, and the same of what has changed.
MEMS_STICTION_VECTORIZED void addStep(std::size_t count, double length, const float* step,
                                      double* values, float* change) {
  for (std::size_t i = 0; i < count; ++i) {
    const double move = length * static_cast<double>(step[i]);
    values[i] += move;
    change[i] += static_cast<float>(move);
  }
}
MEMS_STICTION_VECTORIZED void addStep(std::size_t count, double length, const float* step,
                                      double* values) {
  for (std::size_t i = 0; i < count; ++i) values[i] += length * static_cast<double>(step[i]);
}

}  // namespace

RevertibleDisplacement::RevertibleDisplacement(const HalfSpaceGrid& grid, bool tracks_traction,
                                               int threads, const std::atomic<bool>* cancel)
    : grid_(grid), tracks_traction_(tracks_traction), threads_(threads) {
  const auto make = [&](auto& array) {
    if (cancel == nullptr || !cancel->load()) array.assign(grid.size(), {});
  };
  make(values_);
  make(traction_);
  make(change_);
  make(last_change_);
  if (!tracks_traction) return;
  make(change_traction_);
  make(last_change_traction_);
}

void RevertibleDisplacement::addStaleness(double traction) {
  staleness_ += traction;
  change_staleness_ += traction;
}

void RevertibleDisplacement::begin(double share, double traction_error) {
  swapChanges();
  share_ = static_cast<float>(share);
  change_staleness_ = staleness_;
  if (share != 0.0) addStaleness(tracks_traction_ ? traction_error : kUnknown);
}

std::optional<float> RevertibleDisplacement::takeShare() {
  return std::exchange(share_, std::nullopt);
}

void RevertibleDisplacement::goOn(int row, float share) {
  const std::size_t first = grid_.offset(row);
  const auto cols = static_cast<std::size_t>(grid_.cols);
  addShare(cols, share, last_change_.data() + first, values_.data() + first,
           change_.data() + first);
  if (!tracks_traction_) return;
  addShare(cols, share, last_change_traction_.data() + first, traction_.data() + first,
           change_traction_.data() + first);
}

void RevertibleDisplacement::step(int row, const Step& step) {
  const std::size_t first = grid_.offset(row);
  const auto cols = static_cast<std::size_t>(grid_.cols);
  addStep(cols, step.length, step.step, values_.data() + first, change_.data() + first);
  if (tracks_traction_) {
    addStep(cols, step.length, step.traction, traction_.data() + first,
            change_traction_.data() + first);
  } else {
    addStep(cols, step.length, step.traction, traction_.data() + first);
  }
}

void RevertibleDisplacement::swapChanges() {
  std::swap(change_, last_change_);
  std::swap(change_traction_, last_change_traction_);
}

void RevertibleDisplacement::takeBack() {
  takeBackForPart();
  swapChanges();
}

void RevertibleDisplacement::takeBackForPart() {
  forEachRow(grid_.rows, threads_, [&](int row) {
    const std::size_t first = grid_.offset(row);
    const std::size_t end = first + static_cast<std::size_t>(grid_.cols);
    for (std::size_t i = first; i < end; ++i) values_[i] -= static_cast<double>(change_[i]);
    if (!tracks_traction_) return;
    for (std::size_t i = first; i < end; ++i)
      traction_[i] -= static_cast<double>(change_traction_[i]);
  });
  staleness_ = tracks_traction_ ? change_staleness_ : kUnknown;
}

void RevertibleDisplacement::goTo(Place&& place) {
  values_ = std::move(place.values);
  traction_ = std::move(place.traction);
  staleness_ = place.staleness;
}

void RevertibleDisplacement::reset() {
  for (auto* const array : {&values_, &traction_}) std::fill(array->begin(), array->end(), 0.0);
  staleness_ = 0.0;
  share_ = 0.0F;
}

}  // namespace mems_stiction
