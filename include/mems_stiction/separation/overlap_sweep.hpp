#pragma once

/// @file
/// Which cells overlap at an approach, and to which patches do they belong? Cells come in one by one in order of gap;
/// a union-find over the patches joins what touches. A step costs only the cells that it adds.

#include <cstdint>
#include <vector>

#include "mems_stiction/approach/approach_options.hpp"
#include "mems_stiction/approach/gap_field.hpp"
#include "mems_stiction/approach/gap_order.hpp"
#include "mems_stiction/base/large_pages.hpp"
#include "mems_stiction/separation/overlap_patch.hpp"

namespace mems_stiction {

/// The patches of an approach that only moves forward.
class OverlapSweep {
 public:
  /// Starts with no cell. The field must outlive the sweep's use; memory is reused.
  void start(const GapField& field, Connectivity connectivity);

  /// Brings the ordered cells with a gap below `approach` [m] in.
  /// @return how many are in
  int advanceTo(double approach, GapOrder& order);

  /// The cells that are in, in the order in which they came.
  const std::vector<std::int32_t>& insertedCells() const { return inserted_cells_; }
  /// Ids of the patches that exist now; their order depends on the cells alone.
  const std::vector<std::int32_t>& livePatches() const { return live_; }
  const OverlapPatch& patch(std::int32_t id) const { return patches_[static_cast<std::size_t>(id)]; }
  /// One more than the largest id so far.
  std::size_t idEnd() const { return patches_.size(); }
  /// Patch that holds a cell, or -1.
  std::int32_t patchOf(int cell) {
    const std::int32_t id = patch_of_cell_[static_cast<std::size_t>(cell)];
    return id < 0 ? -1 : rootOf(id);
  }

 private:
  void insert(const OrderedCell& ordered);
  std::int32_t rootOf(std::int32_t id);
  std::int32_t unite(std::int32_t a, std::int32_t b, double gap);

  const GapField* field_ = nullptr;
  Connectivity connectivity_ = Connectivity::kFour;
  int inserted_ = 0;
  LargePageVector<std::int32_t> patch_of_cell_;  ///< -1: not in
  std::vector<std::int32_t> inserted_cells_;
  std::vector<OverlapPatch> patches_;
  std::vector<std::int32_t> parent_;
  std::vector<std::int32_t> live_;
  std::vector<std::int32_t> live_place_;
};

}  // namespace mems_stiction
