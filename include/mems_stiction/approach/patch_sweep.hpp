#pragma once

/// The approach as one sweep: cells come into contact one by one in order of gap, and a union-find keeps the contact
/// patches with their additive attributes. Every step of the approach costs only the cells that it adds; relabelling
/// the frame at each step gives the same patches (test/support/plain_adhesion_model.hpp does that).

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mems_stiction/approach/approach_options.hpp"
#include "mems_stiction/approach/contact_patch.hpp"
#include "mems_stiction/approach/gap_field.hpp"
#include "mems_stiction/approach/gap_order.hpp"

namespace mems_stiction {

class PatchSweep {
 public:
  /// Starts with no cell in contact. The field and the order must outlive the sweep's use; memory is reused.
  void begin(const GapField& field, const GapOrder& order, Connectivity connectivity);

  /// Brings the first `count` cells of the order into contact; starts over if fewer are asked for than are in.
  void advanceTo(int count);
  int contactCount() const { return inserted_; }

  /// Ids of the patches that exist now, in an order that depends only on the cells in contact and their order.
  const std::vector<std::int32_t>& livePatches() const { return live_; }
  const ContactPatch& patch(std::int32_t id) const { return patches_[static_cast<std::size_t>(id)]; }
  /// One more than the largest patch id so far.
  int patchIdEnd() const { return static_cast<int>(patches_.size()); }

  /// Ids of the live patches that have changed, or moved to another place in livePatches(), since the last call (all of
  /// them after a restart).
  const std::vector<std::int32_t>& takeChangedPatches();

  /// Place of a live patch in livePatches().
  std::int32_t livePlace(std::int32_t id) const { return live_place_[static_cast<std::size_t>(id)]; }

  /// Patch that holds the cell, or -1 if the cell is not in contact.
  std::int32_t patchOf(int cell) { return patchOf(field_->cellAt(cell)); }
  std::int32_t patchOf(const GridCell& cell);

 private:
  void restart();
  void insert(const OrderedCell& cell);
  /// Patch `id` (-1: none yet) together with the patch of a neighbour's label.
  std::int32_t joined(std::int32_t id, std::int32_t label);
  std::int32_t addPatch(const ContactPatch& patch);
  std::size_t placeOf(std::int32_t cell, std::int32_t row) const;
  void prefetch(const OrderedCell& cell) const;
  void prefetchPatches(const OrderedCell& cell) const;
  std::int32_t unite(std::int32_t a, std::int32_t b);
  std::int32_t root(std::int32_t id);
  void markChanged(std::int32_t id);

  const GapField* field_ = nullptr;
  const GapOrder* order_ = nullptr;
  Connectivity connectivity_ = Connectivity::kFour;
  int inserted_ = 0;
  std::ptrdiff_t stride_ = 0;         ///< of label_, which has a border of one cell around the frame
  std::vector<std::int32_t> label_;   ///< per cell: the patch that it joined, kApart or kNoCell
  std::vector<std::int32_t> parent_;  ///< per patch: itself, or the patch that it merged into
  std::vector<ContactPatch> patches_;
  std::vector<std::int32_t> live_;
  std::vector<std::int32_t> live_place_;
  std::vector<std::int32_t> changed_;
  std::vector<std::int32_t> changed_live_;
  std::vector<std::uint8_t> is_changed_;
};

}  // namespace mems_stiction
