#pragma once

/// @file
/// White noise that is numbered by place: what a cell holds depends on the seed, the layer and the
/// cell alone, not on which cells were asked for before.
///
/// The bits come from Philox4x32-10, a generator that turns a counter into bits without a state
/// (Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11,
/// doi:10.1145/2063384.2063405); its authors' library Random123 has it, tested against TestU01's
/// BigCrush. The counter is (column/4, row, layer); the key is the seed. Box and Muller's formula
/// makes two standard normal numbers of two 32-bit ones, in double precision, by series of
/// additions and multiplications alone, so that the bits are the same on every processor. The
/// largest number that it makes is 6.7.

#include <cstdint>
#include <vector>

namespace mems_stiction {

/// The noise of one seed and layer.
class NumberedNoise {
 public:
  NumberedNoise(std::uint64_t seed, std::uint32_t layer) : seed_(seed), layer_(layer) {}

  /// Goes on as the noise of another seed.
  void reseed(std::uint64_t seed);
  /// Remembers rows that were asked for until those `rows` further are, in `cols` columns from
  /// `col` on: parts that overlap are then made once.
  void remember(std::int64_t rows, std::int64_t col, std::int64_t cols);

  /// Standard normal numbers of the cells (row, col) to (row, col + count - 1).
  /// - @p col, @p count multiples of 8; rows and columns are taken modulo 2^32 and 2^34
  void fill(std::int64_t row, std::int64_t col, int count, float* values);

 private:
  /// What is known of a row: columns [begin, end).
  struct KnownRow {
    std::int64_t row = 0;
    std::int64_t begin = 0;
    std::int64_t end = 0;
  };

  void make(std::int64_t row, std::int64_t col, int count, float* values);

  std::uint64_t seed_;
  std::uint32_t layer_;
  std::vector<std::uint32_t> radii_;
  std::vector<std::uint32_t> angles_;
  std::vector<KnownRow>
      known_;  ///< a row at its number modulo their count; none: no row is remembered
  std::vector<float> remembered_;  ///< their values
  std::int64_t first_col_ = 0;
  std::int64_t col_count_ = 0;
};

}  // namespace mems_stiction
