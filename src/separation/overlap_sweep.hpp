#pragma once

/// @file
/// Which cells overlap at an approach, and to which patches do they belong? Cells come in in order
/// of gap; each joins the patch of its dale, and where dales meet, so do patches. A step costs only
/// the cells that it adds. A cell asks nothing of its neighbours unless it lies where dales meet,
/// and cells are put in order one by one only where patches meet.

#include <cstdint>
#include <vector>

#include "approach/dale_map.hpp"
#include "approach/gap_field.hpp"
#include "approach/gap_order.hpp"
#include "approach/joined_dales.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "separation/overlap_patch.hpp"

namespace mems_stiction {

/// The patches of an approach that only moves forward. A copy is a place to go on from.
class OverlapSweep {
 public:
  /// Starts with no cell. Field and dales must outlive the sweep's use; memory is reused.
  void start(const GapField& field, DaleMap& dales, Connectivity connectivity);

  /// Brings the ordered cells with a gap below `approach` [m] in.
  /// - @p order built with the dales
  /// - @p ahead a sweep of the same order that may have taken these cells already: it knows where
  /// patches meet
  /// @return how many are in
  int advanceTo(double approach, GapOrder& order, const OverlapSweep* ahead = nullptr);

  /// Cells with a smaller gap are in [m].
  double approach() const { return approach_; }
  /// That are in.
  int cellCount() const { return inserted_; }
  /// Ids of the patches that exist now; their order depends on the cells alone.
  const std::vector<std::int32_t>& livePatches() const { return live_; }
  /// The patches of livePatches(), in their order.
  const std::vector<OverlapPatch>& patches() const { return patches_; }
  /// Place of a live patch in livePatches().
  std::int32_t livePlace(std::int32_t id) const {
    return live_place_[static_cast<std::size_t>(id)];
  }
  /// Patch that holds a cell, or -1.
  std::int32_t patchOf(const GridCell& cell);
  /// Patch that holds a cell of the order that is in.
  std::int32_t patchOf(const OrderedCell& ordered) const {
    return joined_.patchOf(ordered.tag.dale());
  }
  /// Dales that are known; a dale's patch need not be a live one.
  int daleCount() const { return joined_.count(); }
  std::int32_t patchOfDale(std::int32_t dale) const { return joined_.patchOf(dale); }

 private:
  static constexpr std::int32_t kNone = -1;

  /// Whether cells of a group, from the next to come in up to this place, bring patches together.
  bool patchesMeetBefore(int end, const GapOrder& order) const;
  void insert(std::int32_t id, const OrderedCell& ordered);
  /// The patch of the cell's dale together with those that the cell touches.
  std::int32_t join(std::int32_t id, const OrderedCell& ordered);
  std::int32_t unite(std::int32_t a, std::int32_t b, double gap);

  const GapField* field_ = nullptr;
  DaleMap* dales_ = nullptr;
  Connectivity connectivity_ = Connectivity::kFour;
  int inserted_ = 0;
  double approach_ = 0.0;  ///< cells with a smaller gap are in [m]
  JoinedDales joined_;
  std::vector<std::int32_t> live_;
  std::vector<OverlapPatch> patches_;      ///< of live_
  std::vector<std::int32_t> live_place_;   ///< per dale; kNone before its first cell is in
  std::vector<std::uint8_t> has_meeting_;  ///< per group of the order
};

}  // namespace mems_stiction
