#pragma once

/// @file
/// By how much do two thick bodies give way where some cells of a periodic frame are pressed?
///
///     (C p)_q = 2/(E q) p_q
///
/// of a wave of number q (Johnson, Contact Mechanics, chapter 13). Pressures are spread onto blocks
/// of cells, and what blocks give way is read between their middles. Waves too short for blocks
/// act where they are: their mean compliance does, cell by cell.
///
///     PeriodicCompliance compliance;
///     compliance.start(field, 4);
///     compliance.give(cells, pressures, contact_modulus, ways);

#include <cstdint>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"
#include "surface/frame_filter.hpp"

namespace mems_stiction {

/// Keeps its memory, transforms and compliances between frames of one size.
class PeriodicCompliance {
 public:
  /// - @p cells_per_side of a block, about
  void start(const GapField& field, int cells_per_side);
  /// C p at the cells [m]; others bear nothing.
  /// - @p pressures of the cells [Pa]
  /// - @p contact_modulus E [Pa]
  void give(const PressedCells& cells, const std::vector<double>& pressures, double contact_modulus,
            std::vector<double>& ways);

 private:
  /// Where a row or column of cells lies between the middles of the blocks on both sides.
  struct Between {
    int before;
    int behind;
    double share;  ///< of the one behind
  };

  static std::vector<Between> betweenBlocks(int cells, int blocks);
  /// Pressures of the cells on the blocks beside them [Pa].
  void spread(const PressedCells& cells, const std::vector<double>& pressures);
  /// Those of some columns of a row, on the blocks of line_.
  void spreadAlong(const std::int32_t* columns, const double* pressures, int count);

  cv::Size frame_;
  cv::Size blocks_;
  double pitch_x_ = 0.0;
  double pitch_y_ = 0.0;
  double cells_per_block_ = 1.0;
  double short_waves_ = 0.0;  ///< E times the compliance of waves too short for blocks [m]
  std::vector<Between> rows_;
  std::vector<Between> cols_;
  std::vector<double> line_;  ///< a row of blocks
  std::optional<FrameFilter> filter_;
  cv::Mat gains_;  ///< as FrameFilter takes them [m]
};

}  // namespace mems_stiction
