#pragma once

/// @file
/// The dales of the gap (ISO 25178-2: the regions around the pits, from which paths lead down to
/// the pit): each cell follows one downward path, to the left or up if that leads down, else to the
/// lower one of right and below.
///
/// Down is to cells that come into contact before (cell_order.hpp), and no two cells are equal. A
/// cell that comes into contact in the order of the gap then either starts a patch, as the pit of a
/// dale, or touches the patch of its own dale: which patch a cell joins first is known before the
/// approach begins, and patches meet only where dales do.

#include <cstdint>
#include <vector>

#include "approach/gap_field.hpp"
#include "numeric/large_pages.hpp"

namespace mems_stiction {

/// A cell's dale, and where it touches others.
class DaleTag {
 public:
  DaleTag() = default;
  /// - @p dale less than 2^28
  /// - @p sides a bit for each Side where a neighbour that comes into contact before may belong to
  /// another dale
  DaleTag(std::int32_t dale, std::uint32_t sides)
      : bits_(static_cast<std::uint32_t>(dale) << kSideBits | sides) {}

  std::int32_t dale() const { return static_cast<std::int32_t>(bits_ >> kSideBits); }
  bool isBorder() const { return (bits_ & kAllSides) != 0; }
  bool isBorderAt(Side side) const { return (bits_ >> side & 1U) != 0; }

  static constexpr std::uint32_t kAllSides = 15;

 private:
  static constexpr std::uint32_t kSideBits = 4;

  std::uint32_t bits_ = 0;
};

/// The dale of each cell, found out as the approach asks for it.
class DaleMap {
 public:
  /// Forgets all dales. The field must outlive the map's use; memory is reused.
  void start(const GapField& field);

  /// Dale of a valid cell; follows the path downward when it is not known yet.
  std::int32_t find(const GridCell& cell) { return at(cell) == kUnknown ? follow(cell) : at(cell); }
  /// Makes the dales of these cells of a row known: in order of the frame, most have their
  /// neighbour's.
  /// - @p cols in ascending order
  /// - @p gaps, @p gaps_above of the row and of the one above it [m]: from one cell before the
  /// first, infinite where
  ///      the frame has no cell
  void findInRow(int row, const std::int32_t* cols, int count, const double* gaps,
                 const double* gaps_above);
  /// Dale of a cell, or kUnknown if nobody has asked for it, or if the cell is not valid.
  std::int32_t at(const GridCell& cell) const { return dale_[place(cell)]; }
  /// Number of dales found so far; they are numbered in the order in which they were found.
  int count() const { return count_; }

  /// at() of every cell, row by row.
  const std::int32_t* data() const { return dale_.data(); }

  static constexpr std::int32_t kUnknown = -1;

 private:
  std::size_t place(const GridCell& cell) const { return static_cast<std::size_t>(cell.index); }
  std::int32_t follow(const GridCell& cell);
  template <typename Scalar>
  std::int32_t follow(const GridCell& cell, const StoredGaps<Scalar>& gaps);
  /// The next cell of the path; the cell itself if it is a pit.
  template <typename Scalar>
  GridCell below(const GridCell& cell, const StoredGaps<Scalar>& gaps) const;

  const GapField* field_ = nullptr;
  int count_ = 0;
  LargePageVector<std::int32_t> dale_;
  std::vector<std::int32_t> path_;
};

}  // namespace mems_stiction
