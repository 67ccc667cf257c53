#pragma once

/// @file
/// A pass over the frame, row by row, that knows for the cells of a range of gaps the gaps around
/// them, their dales and where dales meet. Dales are found a row ahead: a cell asks for those of
/// its neighbours.
///
///     rows.start(field, dales, 0.0, limit);
///     while (rows.next()) {
///       for (int i = 0; i < rows.count(); ++i) use(rows.columns()[i],
///           rows.around().tagOf(rows.columns()[i]));
///     }

#include <cstdint>
#include <vector>

#include "approach/dale_map.hpp"
#include "approach/gap_field.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {

/// A row and its neighbours: gaps [m], infinite off the frame and readable from one cell before the
/// first to one past the last, and dales.
struct RowsAround {
  const double* gaps;
  const double* above;
  const double* below;
  const std::int32_t* dales;
  const std::int32_t* dales_above;  ///< those of the row itself where the frame ends
  const std::int32_t* dales_below;
  std::int32_t last_col;

  /// The cell's dale, and where it meets others.
  MEMS_STICTION_INLINE DaleTag tagOf(std::int32_t col) const {
    const std::int32_t dale = dales[col];
    const double gap = gaps[col];
    // only neighbours that come into contact before matter
    const double gaps_around[] = {gaps[col - 1], gaps[col + 1], above[col], below[col]};
    const std::int32_t dales_around[] = {dales[col > 0 ? col - 1 : 0],
                                         dales[col < last_col ? col + 1 : col], dales_above[col],
                                         dales_below[col]};
    std::uint32_t sides = 0;
    for (const Side side : kSides) {
      const auto meets = static_cast<std::uint32_t>(comesFirst(side, gaps_around[side], gap)) &
                         static_cast<std::uint32_t>(dales_around[side] != dale);
      sides |= meets << side;
    }
    return DaleTag(dale, sides);
  }
  /// The same of some cells.
  void tagsOf(const std::int32_t* columns, int count, DaleTag* tags) const;
};

/// Keeps its memory between passes.
class DaleRows {
 public:
  /// Stands before the first row.
  /// - @p from, @p limit the cells of interest have a gap in [from, limit) [m]
  void start(const GapField& field, DaleMap& dales, double from, double limit);

  /// Goes to the next row. @return false behind the last one
  bool next();
  int row() const { return row_; }
  /// Columns of the cells of interest, ascending.
  const std::int32_t* columns() const { return columns_[row_ % 2].data(); }
  /// How many there are.
  int count() const { return counts_[row_ % 2]; }
  const RowsAround& around() const { return around_; }

 private:
  void read(int row);
  /// Gaps of a row that was read lately, or of one off the frame, from one cell before the first
  /// [m].
  const double* gapsOf(int row) const;

  const GapField* field_ = nullptr;
  DaleMap* dales_ = nullptr;
  double from_ = 0.0;
  double limit_ = 0.0;
  int row_ = -1;
  static constexpr int kRows = 3;
  std::vector<double> gaps_[kRows];  ///< of the row, the one above and the one below
  std::vector<double> no_row_;       ///< the gaps above and below the frame
  std::vector<std::int32_t> columns_[2];
  int counts_[2] = {0, 0};
  RowsAround around_ = {};
};

}  // namespace mems_stiction
