#include "mems_stiction/separation/relief_waves.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "mems_stiction/base/constants.hpp"

namespace mems_stiction {
namespace {

/// f(q) = 1/(1 + (kLengths l q)^4)
constexpr double kLengths = 2.0;
/// Blocks along each side at most: what is cut away beyond is far shorter than a frame.
constexpr int kMostBlocks = 512;
/// Opposite edges fit each other if they differ by no more than this times what neighbours do.
constexpr double kFittingEdges = 3.0;

/// Blocks are this part of the cohesive length or less, where pixels are.
constexpr double kBlocksPerLength = 2.0;

/// Cells of a block along a side.
int blockSize(int cells, double pitch, double longest) {
  const double by_length = std::clamp(std::floor(longest / pitch), 1.0, static_cast<double>(cells));
  return std::max(static_cast<int>(by_length), (cells + kMostBlocks - 1) / kMostBlocks);
}

/// q of a row or column of a spectrum [1/m].
double waveNumber(int index, int count, double width) {
  return 2.0 * kPi * std::min(index, count - index) / (count * width);
}

/// Root mean square difference of two rows or columns.
double difference(const cv::Mat1d& a, const cv::Mat1d& b) {
  return cv::norm(a, b, cv::NORM_L2) / std::sqrt(static_cast<double>(a.total()));
}

}  // namespace

void ReliefWaves::split(const GapField& field, double contact_modulus, double cohesive_length) {
  takeBlocks(field, cohesive_length);
  const bool is_mirrored = !repeatsItself();
  cv::Mat1d frame = heights_;
  if (is_mirrored) cv::copyMakeBorder(heights_, frame, 0, blocks_.height, 0, blocks_.width, cv::BORDER_REFLECT);
  cv::dft(frame, spectrum_, cv::DFT_COMPLEX_OUTPUT);

  tension_.create(frame.size());
  for (int row = 0; row < frame.rows; ++row) {
    const double q_y = waveNumber(row, frame.rows, block_height_);
    for (int col = 0; col < frame.cols; ++col) {
      const double q = std::hypot(waveNumber(col, frame.cols, block_width_), q_y);
      const double square = kLengths * cohesive_length * q * kLengths * cohesive_length * q;
      const double long_part = 1.0 / (1.0 + square * square);
      cv::Vec2d& wave = spectrum_(row, col);
      wave *= long_part;
      tension_(row, col) = -0.5 * contact_modulus * q * wave;
    }
  }

  cv::dft(tension_, frame, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  cv::minMaxLoc(frame, nullptr, &largest_tension_);
  largest_tension_ = std::max(0.0, largest_tension_);
  cv::dft(spectrum_, frame, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  cv::resize(frame(cv::Rect({0, 0}, blocks_)), long_heights_, {field.cols(), field.rows()}, 0.0, 0.0, cv::INTER_LINEAR);
}

void ReliefWaves::takeBlocks(const GapField& field, double cohesive_length) {
  const int block_rows = blockSize(field.rows(), field.pitchY(), cohesive_length / kBlocksPerLength);
  const int block_cols = blockSize(field.cols(), field.pitchX(), cohesive_length / kBlocksPerLength);
  blocks_ = {(field.cols() + block_cols - 1) / block_cols, (field.rows() + block_rows - 1) / block_rows};
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

bool ReliefWaves::repeatsItself() const {
  const int last_row = blocks_.height - 1;
  const int last_col = blocks_.width - 1;
  if (last_row < 1 || last_col < 1) return true;
  const double over_rows = difference(heights_.row(0), heights_.row(last_row));
  const double over_cols = difference(heights_.col(0), heights_.col(last_col));
  return over_rows <= kFittingEdges * difference(heights_.rowRange(1, last_row + 1), heights_.rowRange(0, last_row)) &&
         over_cols <= kFittingEdges * difference(heights_.colRange(1, last_col + 1), heights_.colRange(0, last_col));
}

}  // namespace mems_stiction
