#pragma once

/// @file
/// The approach as one sweep: cells come into contact one by one in order of gap, and joining the
/// dales of the gap keeps the contact patches with their additive attributes. Every step of the
/// approach costs only the cells that it adds; relabelling the frame at each step gives the same
/// patches (test/support/plain_adhesion_model.hpp does that).

#include <cstddef>
#include <cstdint>
#include <vector>

#include "approach/dale_map.hpp"
#include "approach/gap_field.hpp"
#include "approach/gap_order.hpp"
#include "approach/joined_dales.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "paper/cell_surroundings.hpp"
#include "paper/contact_patch.hpp"

namespace mems_stiction {

/// The patches of an approach that only moves forward.
class PatchSweep {
 public:
  /// Starts with no cell in contact. The field and the order must outlive the sweep's use; memory
  /// is reused.
  void start(const GapField& field, const GapOrder& order, Connectivity connectivity);

  /// Brings the first `count` cells of the order into contact; starts over if fewer are asked for
  /// than are in. The patches are those of a moment of the approach when all cells up to some gap
  /// are in: a step of the order, or a level of a group that is sorted.
  void advanceTo(int count);

  /// Ids of the patches that exist now, in an order that depends only on the cells in contact and
  /// their order.
  const std::vector<std::int32_t>& livePatches() const { return live_; }
  const ContactPatch& patch(std::int32_t id) const {
    return patches_[static_cast<std::size_t>(id)];
  }

  /// Ids of the live patches that have changed, or moved to another place in livePatches(), since
  /// the last call (all of them after a restart).
  const std::vector<std::int32_t>& takeChangedPatches();

  /// Place of a live patch in livePatches().
  std::int32_t livePlace(std::int32_t id) const {
    return live_place_[static_cast<std::size_t>(id)];
  }

  /// Patch that contains the cell, or -1 if the cell is not in contact. Cells of equal gap come
  /// into contact together.
  std::int32_t patchOf(int cell) { return patchOf(field_->cellAt(cell)); }
  std::int32_t patchOf(const GridCell& cell);

 private:
  void restart();
  /// One more than the largest patch id so far.
  int patchIdEnd() const { return static_cast<int>(patches_.size()); }
  /// A patch for every dale that is known.
  void makeRoom();
  /// Brings the next cell of the order into contact.
  void insertNext();
  /// The patch of the cell's dale together with those that the cell touches.
  std::int32_t join(std::int32_t id, const GridCell& cell, double gap,
                    const CellSurroundings& around);
  std::int32_t unite(std::int32_t a, std::int32_t b);
  void markChanged(std::int32_t id);

  const GapField* field_ = nullptr;
  const GapOrder* order_ = nullptr;
  Connectivity connectivity_ = Connectivity::kFour;
  int inserted_ = 0;
  DaleMap dales_;
  SurroundingsTable surroundings_;
  JoinedDales joined_;
  std::vector<ContactPatch>
      patches_;  ///< per dale; of area 0 before its first cell comes into contact
  std::vector<std::int32_t> live_;
  std::vector<std::int32_t> live_place_;
  std::vector<std::int32_t> changed_;  ///< since takeChangedPatches()
  std::vector<std::int32_t> changed_live_;
  std::vector<std::uint8_t> is_changed_;
};

}  // namespace mems_stiction
