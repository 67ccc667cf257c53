#pragma once

/// @file
/// White noise convolved with a kernel, in blocks that fit together without a seam.
///
/// The kernel is cut off at a margin, by a window that falls smoothly to zero over the last quarter
/// of it. A transform that is longer than the block by the margin on both sides then gives the
/// convolution exactly, so what a cell holds does not depend on the block it is in, but for
/// round-off. Noise is real and the kernel symmetric: two halves of a block, side by side, are the
/// real and the imaginary part of one complex transform.

#include <cstdint>
#include <functional>
#include <vector>

#include "numeric/float_packet.hpp"
#include "numeric/large_pages.hpp"
#include "surface/line_waves.hpp"
#include "surface/numbered_noise.hpp"

namespace mems_stiction {

/// Cells along both axes.
struct BlockSize {
  int rows = 0;
  int cols = 0;
};

enum class BlockChoice {
  kFast,   ///< least time for each of many cells
  kSmall,  ///< least time where few cells are wanted
  kWhole   ///< no blocks: one transform of the whole surface (whole_frame.hpp), for TiledSurface
           ///< alone
};

/// How a convolution may be laid out.
struct BlockLayout {
  BlockChoice choice = BlockChoice::kFast;
  double reach_rows = 1.0;  ///< how many times further the kernel reaches over rows, >= 1 ...
  double reach_cols = 1.0;  ///< ... and over columns, than that of a round spectrum
  bool for_spline = false;  ///< whether the gain is that of a cubic spline over the cells: its
                            ///< coefficients are made
};

/// Memory that convolutions share, which work one after the other.
struct ConvolutionMemory {
  LargePageVector<Complex<FloatPacket>> waves;
  std::vector<Complex<FloatPacket>> columns;
  std::vector<float> noise;
};

/// What a wave (k_x, k_y) [rad/cell], both from -pi to pi, is multiplied with; gain(-k) = gain(k).
using WaveGain = std::function<double(double, double)>;

/// Filters white noise by a gain.
class BlockConvolution {
 public:
  /// Whether a kernel of this reach fits into the largest transform.
  static bool fits(double reach_rows, double reach_cols);

  /// - @p layout of a reach that fits
  BlockConvolution(const WaveGain& gain, const BlockLayout& layout);

  /// Mean square of what comes out (of the spline's values): that of the whole kernel, to which it
  /// is scaled when it has been cut off.
  double variance() const { return variance_; }
  /// Share of it that was cut off.
  double neglected() const { return neglected_; }
  /// Cells of one block. Blocks begin at multiples of them, which are multiples of 16.
  BlockSize block() const {
    return {rowCount() - 2 * margin_.rows, 2 * (colCount() - 2 * margin_.cols)};
  }

  /// Cells beyond its own that the noise of a block is asked for, on each side.
  BlockSize margin() const { return margin_; }

  /// Block number (block_row, block_col), row by row.
  void make(NumberedNoise& noise, std::int64_t block_row, std::int64_t block_col,
            ConvolutionMemory& memory, float* values) const;

 private:
  struct Kernel;
  explicit BlockConvolution(const Kernel& kernel);

  int rowCount() const { return static_cast<int>(rows_.length()); }
  int colCount() const { return static_cast<int>(cols_.length()); }

  BlockSize margin_;
  LineWaves<float> rows_;  ///< along a column
  LineWaves<float> cols_;  ///< along a row
  double variance_;
  double neglected_;
  std::vector<float> gains_;  ///< of the waves, in the order of the transforms: a row of eight
                              ///< columns, then the next
};

}  // namespace mems_stiction
