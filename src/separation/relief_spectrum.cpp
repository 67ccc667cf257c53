#include "separation/relief_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// Cells of a block along a side.
int blockSize(int cells, double pitch, double longest) {
  const double by_length = std::clamp(std::floor(longest / pitch), 1.0, static_cast<double>(cells));
  return std::max(static_cast<int>(by_length), (cells + chosen::kParts - 1) / chosen::kParts);
}

int blockCount(int cells, int size) { return (cells + size - 1) / size; }

/// q of a row or column of a spectrum [1/m].
double waveNumber(int index, int count, double width) {
  return 2.0 * kPi * std::min(index, count - index) / (count * width);
}

double rmsOf(const cv::Mat1d& heights) {
  return cv::norm(heights, cv::NORM_L2) / std::sqrt(static_cast<double>(heights.total()));
}

}  // namespace

void ReliefSpectrum::take(const GapField& field, double longest_block) {
  takeBlocks(field, longest_block);
  frame_ = heights_;
  if (!repeatsItself()) cv::copyMakeBorder(heights_, frame_, 0, blocks_.height, 0, blocks_.width, cv::BORDER_REFLECT);
  cv::dft(frame_, spectrum_, cv::DFT_COMPLEX_OUTPUT);
  takeWaveNumbers();
}

void ReliefSpectrum::takeWaveNumbers() {
  wave_numbers_.create(frame_.size());
  for (int row = 0; row < frame_.rows; ++row) {
    const double q_y = waveNumber(row, frame_.rows, block_height_);
    for (int col = 0; col < frame_.cols; ++col) {
      wave_numbers_(row, col) = std::hypot(waveNumber(col, frame_.cols, block_width_), q_y);
    }
  }
}

void ReliefSpectrum::takeBlocks(const GapField& field, double longest_block) {
  const int block_rows = blockSize(field.rows(), field.pitchY(), longest_block);
  const int block_cols = blockSize(field.cols(), field.pitchX(), longest_block);
  blocks_ = {blockCount(field.cols(), block_cols), blockCount(field.rows(), block_rows)};
  block_width_ = field.cols() * field.pitchX() / blocks_.width;
  block_height_ = field.rows() * field.pitchY() / blocks_.height;
  heights_.create(blocks_);
  counts_.create(blocks_);
  heights_ = 0.0;
  counts_ = 0;
  line_.resize(static_cast<std::size_t>(field.cols()));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line_.data());
    // of equal size but for rounding, so that the blocks are the cells of an image that cv::resize makes as large again
    const auto block_row = static_cast<int>(static_cast<std::int64_t>(row) * blocks_.height / field.rows());
    for (int col = 0; col < field.cols(); ++col) {
      const double gap = line_[static_cast<std::size_t>(col)];
      if (!(gap <= field.largestGap())) continue;
      const auto block_col = static_cast<int>(static_cast<std::int64_t>(col) * blocks_.width / field.cols());
      heights_(block_row, block_col) += field.meanGap() - gap;
      ++counts_(block_row, block_col);
    }
  }
  for (int row = 0; row < blocks_.height; ++row) {
    for (int col = 0; col < blocks_.width; ++col) {
      if (counts_(row, col) > 0) heights_(row, col) /= counts_(row, col);
    }
  }
}

bool ReliefSpectrum::repeatsItself() const {
  const int last_row = blocks_.height - 1;
  const int last_col = blocks_.width - 1;
  if (last_row < 1 || last_col < 1) return true;
  // heights that have nothing to do with each other differ by sqrt(2) of what they have
  const double height = rmsOf(heights_);
  return rmsOf(heights_.row(0) - heights_.row(last_row)) <= height &&
         rmsOf(heights_.col(0) - heights_.col(last_col)) <= height;
}

}  // namespace mems_stiction
