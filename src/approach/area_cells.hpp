#pragma once

/// @file
/// What contacts need to know of an area that is too large to be held as a frame: its highest
/// cells, one by one, and how many others lie at which height.
///
/// Tiles come in one by one, in any order, here or elsewhere: AreaCells of other tiles are added.
/// What is kept depends on the relief alone, to the bit.
///
///     AreaCells cells(pitch, pitch);
///     for (...) cells.add(first_row, first_col, relief_of_tile);

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "approach/height_counts.hpp"

namespace mems_stiction {

/// One of the highest places of an area.
struct AreaCell {
  std::int32_t row = 0;
  std::int32_t col = 0;
  double relief = 0.0;  ///< z1 - z2 [m]
};

/// Which cells are kept one by one. Both limits hold; a level is taken to the next bucket of the
/// counts above it.
struct AreaCellLimits {
  double depth =
      std::numeric_limits<double>::infinity();  ///< none that far below the highest of all [m]
  std::int64_t most_cells =
      std::int64_t{1} << 22U;  ///< none below the level at which there are more; 16 bytes each
};

/// Of one area, or of a part of it.
class AreaCells {
 public:
  /// @throw SurfaceError unless both pitches [m] are above 0, and the limits let any cell through.
  AreaCells(double pitch_x, double pitch_y, const AreaCellLimits& limits = {});

  /// Adds a tile. Tiles need not fill the area: what never comes is not there. Rows that are left
  /// out between separate pieces of surface keep them apart.
  /// - @p row, @p col of its first pixel in the area, within 2^30
  /// - @p relief z1 - z2, CV_32FC1 or CV_64FC1 [m] from a level that is that of all tiles, within
  /// 1000 m; others than finite ones
  ///   are invalid
  /// @throw SurfaceError if it is another.
  void add(std::int64_t row, std::int64_t col, const cv::Mat& relief);
  /// Adds other parts of the same area, collected with the same limits.
  /// @throw SurfaceError if pitch or limits are others.
  void add(const AreaCells& other);

  double pitchX() const { return pitch_x_; }
  double pitchY() const { return pitch_y_; }
  const AreaCellLimits& limits() const { return limits_; }

  /// All valid cells by height.
  const HeightCounts& counts() const { return counts_; }
  std::int64_t validCount() const { return counts_.total(); }
  double area() const {
    return static_cast<double>(validCount()) * pitch_x_ * pitch_y_;
  }  ///< of the valid cells [m^2]
  /// The highest relief [m]; NaN without a valid cell.
  double highest() const { return highest_; }

  /// The bucket from which on upwards cells are kept.
  std::int64_t levelBucket() const;
  /// Above this height cells are kept [m].
  double level() const { return counts_.lowerEnd(levelBucket()); }
  /// Number of cells that are kept.
  std::int64_t cellCount() const;
  /// Those from a bucket on, which is not below levelBucket(), row by row.
  /// @throw SurfaceError if one of them was added twice.
  std::vector<AreaCell> cellsFrom(std::int64_t bucket) const;

  /// Most memory that it holds now [bytes].
  std::size_t memory() const { return counts_.memory() + cells_.capacity() * sizeof(AreaCell); }

  /// For other processes, on machines of the same order of bytes. The same cells give the same
  /// bytes.
  std::string toBytes() const;
  /// @throw SurfaceError if the bytes are not whole, or of another version.
  static AreaCells fromBytes(std::string_view bytes);

 private:
  template <typename Scalar>
  void addRow(std::int64_t row, std::int64_t col, const Scalar* line, std::size_t size);
  static constexpr std::int64_t kNoLevel = std::numeric_limits<std::int64_t>::min();

  /// The finest bucket from which on upwards cells are kept by both limits, or by depth alone: it
  /// only rises while cells come in.
  std::int64_t finestLevel() const;
  std::int64_t levelByDepth() const;
  /// So many cells are held at most after each row, those included that will not be kept.
  std::int64_t mostInMemory() const;
  void makeRoom(std::size_t more);
  /// Drops cells that will not be kept, if they have become many.
  void dropCells();

  double pitch_x_;
  double pitch_y_;
  AreaCellLimits limits_;
  HeightCounts counts_;
  double highest_ = std::numeric_limits<double>::quiet_NaN();
  std::int64_t dropped_below_ = kNoLevel;  ///< finest bucket: cells below it are not held
  std::vector<AreaCell> cells_;            ///< those that are kept, and maybe others
  std::vector<std::int32_t> slots_;        ///< of a row
  std::vector<AreaCell> row_cells_;        ///< of a row, those that are held
};

}  // namespace mems_stiction
