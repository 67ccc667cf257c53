#include "separation/flattening_waves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// Blocks along a side of so many cells.
int blockCount(int cells) {
  const int size = (cells + chosen::kParts - 1) / chosen::kParts;
  return (cells + size - 1) / size;
}

/// q of a row or column of a spectrum [1/m].
double waveNumber(int index, int count, double width) {
  return 2.0 * kPi * std::min(index, count - index) / (count * width);
}

double rmsOf(const cv::Mat1d& heights) {
  return cv::norm(heights, cv::NORM_L2) / std::sqrt(static_cast<double>(heights.total()));
}

}  // namespace

double FlatteningWaves::of(const GapField& field, double contact_modulus) {
  takeBlocks(field);
  takeSpectrum();
  const double of_long_waves = takeLongWaves({field.cols(), field.rows()}, contact_modulus);
  return of_long_waves + of_lines_.of(field, long_heights_, contact_modulus);
}

void FlatteningWaves::takeBlocks(const GapField& field) {
  blocks_ = {blockCount(field.cols()), blockCount(field.rows())};
  block_width_ = field.cols() * field.pitchX() / blocks_.width;
  block_height_ = field.rows() * field.pitchY() / blocks_.height;
  heights_.create(blocks_);
  counts_.create(blocks_);
  heights_ = 0.0;
  counts_ = 0;
  line_.resize(static_cast<std::size_t>(field.cols()));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line_.data());
    // of equal size but for rounding, so that the blocks are the cells of an image that cv::resize
    // makes as large again
    const auto block_row =
        static_cast<int>(static_cast<std::int64_t>(row) * blocks_.height / field.rows());
    for (int col = 0; col < field.cols(); ++col) {
      const double gap = line_[static_cast<std::size_t>(col)];
      if (!(gap <= field.largestGap())) continue;
      const auto block_col =
          static_cast<int>(static_cast<std::int64_t>(col) * blocks_.width / field.cols());
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

bool FlatteningWaves::repeatsItself() const {
  const int last_row = blocks_.height - 1;
  const int last_col = blocks_.width - 1;
  if (last_row < 1 || last_col < 1) return true;
  // heights that have nothing to do with each other differ by sqrt(2) of what they have
  const double height = rmsOf(heights_);
  return rmsOf(heights_.row(0) - heights_.row(last_row)) <= height &&
         rmsOf(heights_.col(0) - heights_.col(last_col)) <= height;
}

void FlatteningWaves::takeSpectrum() {
  frame_ = heights_;
  if (!repeatsItself())
    cv::copyMakeBorder(heights_, frame_, 0, blocks_.height, 0, blocks_.width, cv::BORDER_REFLECT);
  cv::dft(frame_, spectrum_, cv::DFT_COMPLEX_OUTPUT);
}

double FlatteningWaves::takeLongWaves(cv::Size cells, double contact_modulus) {
  const double length = std::max(block_width_, block_height_);
  double sum = 0.0;
  for (int row = 0; row < spectrum_.rows; ++row) {
    const double q_y = waveNumber(row, spectrum_.rows, block_height_);
    for (int col = 0; col < spectrum_.cols; ++col) {
      const double q = std::hypot(waveNumber(col, spectrum_.cols, block_width_), q_y);
      const double long_part = 1.0 / (1.0 + length * q * length * q);
      const double left = 1.0 - long_part;
      cv::Vec2d& wave = spectrum_(row, col);
      sum += (wave[0] * wave[0] + wave[1] * wave[1]) *
             (0.25 * contact_modulus * q * (1.0 - left * left));
      wave *= long_part;
    }
  }
  const auto waves = static_cast<double>(spectrum_.total());
  cv::dft(spectrum_, long_frame_, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  cv::resize(long_frame_(cv::Rect({0, 0}, blocks_)), long_heights_, cells, 0.0, 0.0,
             cv::INTER_LINEAR);
  return sum / (waves * waves);
}

}  // namespace mems_stiction
