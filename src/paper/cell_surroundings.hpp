#pragma once

/// @file
/// What lies around a cell when it comes into contact: all that its patch needs to know of it, in
/// one place of memory.
///
/// The order of the approach jumps about the frame. The table therefore collects the surroundings
/// of the next cells in the order of the frame and leaves them in the order of the approach, a
/// window at a time; a sweep that has taken more than its first few cells then reads memory from
/// front to back.

#include <cstdint>
#include <vector>

#include "approach/dale_map.hpp"
#include "approach/dale_rows.hpp"
#include "approach/gap_field.hpp"
#include "approach/gap_order.hpp"
#include "numeric/large_pages.hpp"
#include "paper/contact_patch.hpp"

namespace mems_stiction {

/// Of one cell.
struct CellSurroundings {
  double gaps[4];     ///< of the neighbours, in the order of Side [m]; infinite where there is none
  std::int32_t cell;  ///< whose surroundings they are
  DaleTag tag;

  std::int32_t dale() const { return tag.dale(); }  ///< of the cell
  /// Whether a neighbour may belong to another dale.
  bool isBorder() const { return tag.isBorder(); }
};

/// A window of them, in the order of the approach.
class SurroundingsTable {
 public:
  /// Nothing is collected yet. Field and order must outlive the table's use; memory is reused.
  void start(const GapField& field, const GapOrder& order, DaleMap& dales);

  /// Collects the window that starts at the group of this place.
  void collectFrom(int place);
  /// The place after its last one.
  int endPlace() const { return end_place_; }
  /// Of the cell at any place of the order: from the window, or looked up in the field if it is not
  /// there, or if its group has been sorted since. Valid until the next call.
  const CellSurroundings& at(int place) {
    const OrderedCell& cell = order_->cells()[static_cast<std::size_t>(place)];
    if (place >= first_place_ && place < end_place_) {
      const CellSurroundings& collected = table_[static_cast<std::size_t>(place - first_place_)];
      if (collected.cell == cell.cell) return collected;
    }
    return lookUp(cell);
  }

 private:
  const CellSurroundings& lookUp(const OrderedCell& cell);
  void collectRow();

  const GapField* field_ = nullptr;
  const GapOrder* order_ = nullptr;
  DaleMap* dales_ = nullptr;
  int first_place_ = 0;
  int end_place_ = 0;
  int first_group_ = 0;
  int end_group_ = 0;
  LargePageVector<CellSurroundings> table_;
  std::vector<std::int32_t> next_place_;  ///< per group of the window, while it is collected
  DaleRows rows_;
  CellSurroundings looked_up_;
};

}  // namespace mems_stiction
