#include "separation/periodic_compliance.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// So many blocks that a transform is quick; as many as cells where a block is one.
int blocksOf(int cells, int cells_per_side) {
  if (cells_per_side == 1) return cells;
  const int wanted = (cells + cells_per_side - 1) / cells_per_side;
  for (int count = std::min(wanted, chosen::kParts); count > 1; --count) {
    if (cv::getOptimalDFTSize(count) == count) return count;
  }
  return 1;
}

/// 2/q less what cells have of themselves [m], over the number of blocks; the mean has no 2/q.
void gainsOf(const cv::Size& blocks, double width, double height, double of_cells, cv::Mat& gains) {
  gains.create(blocks.width / 2 + 1, blocks.height, CV_32FC1);
  for (int x = 0; x < gains.rows; ++x) {
    const double q_x = 2.0 * kPi * x / width;
    float* const line = gains.ptr<float>(x);
    for (int y = 0; y < blocks.height; ++y) {
      const double q_y = 2.0 * kPi * std::min(y, blocks.height - y) / height;
      const double q = std::sqrt(q_x * q_x + q_y * q_y);
      const double by_wave = q > 0.0 ? 2.0 / q : 0.0;
      line[y] = static_cast<float>((by_wave - of_cells) / blocks.area());
    }
  }
}

}  // namespace

std::vector<PeriodicCompliance::Between> PeriodicCompliance::betweenBlocks(int cells, int blocks) {
  std::vector<Between> between(static_cast<std::size_t>(cells));
  for (int cell = 0; cell < cells; ++cell) {
    const double place = (cell + 0.5) * blocks / cells - 0.5;
    const double before = std::floor(place);
    const int block = static_cast<int>(before);
    between[static_cast<std::size_t>(cell)] = {(block + blocks) % blocks, (block + 1) % blocks,
                                               place - before};
  }
  return between;
}

void PeriodicCompliance::start(const GapField& field, int cells_per_side) {
  const cv::Size frame(field.cols(), field.rows());
  const cv::Size blocks(blocksOf(frame.width, cells_per_side),
                        blocksOf(frame.height, cells_per_side));
  if (filter_ && frame == frame_ && blocks == blocks_ && field.pitchX() == pitch_x_ &&
      field.pitchY() == pitch_y_) {
    return;
  }
  if (!filter_ || blocks != blocks_) filter_.emplace(blocks, blocks.height);
  frame_ = frame;
  blocks_ = blocks;
  pitch_x_ = field.pitchX();
  pitch_y_ = field.pitchY();
  rows_ = betweenBlocks(frame.height, blocks.height);
  cols_ = betweenBlocks(frame.width, blocks.width);
  cells_per_block_ = static_cast<double>(field.cellCount()) / blocks.area();
  // the mean of 2/(E q) over the waves from those of blocks to those of cells
  const double pitch = std::sqrt(field.cellArea());
  short_waves_ =
      blocks == frame ? 0.0 : 4.0 * pitch / (kPi * (1.0 + 1.0 / std::sqrt(cells_per_block_)));
  gainsOf(blocks, frame.width * pitch_x_, frame.height * pitch_y_, short_waves_, gains_);
}

void PeriodicCompliance::spread(const PressedCells& cells, const std::vector<double>& pressures) {
  for (int row = 0; row < blocks_.height; ++row)
    std::fill_n(filter_->row(row), blocks_.width, 0.0F);
  const bool is_by_cell = blocks_ == frame_;
  const double share = 1.0 / cells_per_block_;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const Between& at_row = rows_[row];
    float* const before = filter_->row(at_row.before);
    float* const behind = filter_->row(at_row.behind);
    for (int i = cells.row_begin[row]; i < cells.row_begin[row + 1]; ++i) {
      const auto cell = static_cast<std::size_t>(i);
      if (is_by_cell) {
        before[cells.columns[cell]] = static_cast<float>(pressures[cell]);
        continue;
      }
      const Between& at = cols_[static_cast<std::size_t>(cells.columns[cell])];
      const double pressure = share * pressures[cell];
      const double lower = at_row.share * pressure;
      const double upper = pressure - lower;
      before[at.before] += static_cast<float>(upper * (1.0 - at.share));
      before[at.behind] += static_cast<float>(upper * at.share);
      behind[at.before] += static_cast<float>(lower * (1.0 - at.share));
      behind[at.behind] += static_cast<float>(lower * at.share);
    }
  }
}

void PeriodicCompliance::give(const PressedCells& cells, const std::vector<double>& pressures,
                              double contact_modulus, std::vector<double>& ways) {
  spread(cells, pressures);
  filter_->apply(gains_);
  const bool is_by_cell = blocks_ == frame_;
  const double compliance = 1.0 / contact_modulus;
  ways.resize(cells.count());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const Between& at_row = rows_[row];
    const float* const before = filter_->row(at_row.before);
    const float* const behind = filter_->row(at_row.behind);
    for (int i = cells.row_begin[row]; i < cells.row_begin[row + 1]; ++i) {
      const auto cell = static_cast<std::size_t>(i);
      if (is_by_cell) {
        ways[cell] = compliance * before[cells.columns[cell]];
        continue;
      }
      const Between& at = cols_[static_cast<std::size_t>(cells.columns[cell])];
      const double upper = before[at.before] + at.share * (before[at.behind] - before[at.before]);
      const double lower = behind[at.before] + at.share * (behind[at.behind] - behind[at.before]);
      const double by_blocks = upper + at_row.share * (lower - upper);
      ways[cell] = compliance * (by_blocks + short_waves_ * pressures[cell]);
    }
  }
}

}  // namespace mems_stiction
