#pragma once

/// @file
/// The relief between two surfaces as a sum of waves, each of which can be weighed by its length.
///
/// Heights are means over blocks of cells. Cells without a height lie at the mean. The frame repeats itself where its
/// opposite edges differ by no more than its rms height, and is mirrored where they differ by more.

#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"

namespace mems_stiction {

/// The waves of one frame. Keeps its memory between frames.
class ReliefSpectrum {
 public:
  /// - @p longest_block a side of a block [m], where pixels and the most blocks there may be allow it
  void take(const GapField& field, double longest_block);

  /// The sum of the waves, each times weigh(q), q its wave number [1/m]: at every block, and at those of the mirror
  /// images behind. Valid until the next call.
  template <typename Weigh>
  const cv::Mat1d& weighed(const Weigh& weigh);
  /// Sum over the waves of |h_q|^2, each times weigh(q).
  template <typename Weigh>
  double meanSquare(const Weigh& weigh) const;
  double blockWidth() const { return block_width_; }    ///< along x [m]
  double blockHeight() const { return block_height_; }  ///< along y [m]
  /// Rows and columns of blocks of the frame itself.
  cv::Size blocks() const { return blocks_; }
  /// Whether the frame repeats itself, or is mirrored.
  bool repeats() const { return frame_.size() == blocks_; }

 private:
  void takeBlocks(const GapField& field, double longest_block);
  void takeWaveNumbers();
  bool repeatsItself() const;

  cv::Size blocks_;
  double block_width_ = 0.0;   ///< along x [m]
  double block_height_ = 0.0;  ///< along y [m]
  cv::Mat1d heights_;
  cv::Mat1i counts_;
  std::vector<double> line_;
  cv::Mat1d frame_;  ///< with mirror images
  cv::Mat2d spectrum_;
  cv::Mat1d wave_numbers_;  ///< [1/m]
  cv::Mat2d weighed_spectrum_;
  cv::Mat1d weighed_;
};

template <typename Weigh>
double ReliefSpectrum::meanSquare(const Weigh& weigh) const {
  double sum = 0.0;
  for (int row = 0; row < spectrum_.rows; ++row) {
    for (int col = 0; col < spectrum_.cols; ++col) {
      const cv::Vec2d& wave = spectrum_(row, col);
      sum += (wave[0] * wave[0] + wave[1] * wave[1]) * weigh(wave_numbers_(row, col));
    }
  }
  const auto cells = static_cast<double>(spectrum_.total());
  return sum / (cells * cells);
}

template <typename Weigh>
const cv::Mat1d& ReliefSpectrum::weighed(const Weigh& weigh) {
  weighed_spectrum_.create(spectrum_.size());
  for (int row = 0; row < spectrum_.rows; ++row) {
    for (int col = 0; col < spectrum_.cols; ++col) {
      weighed_spectrum_(row, col) = spectrum_(row, col) * weigh(wave_numbers_(row, col));
    }
  }
  cv::dft(weighed_spectrum_, weighed_, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  return weighed_;
}

}  // namespace mems_stiction
