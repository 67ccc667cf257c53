#include "separation/periodic_compliance.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/constants.hpp"
#include "numeric/vectorized.hpp"

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

MEMS_STICTION_VECTORIZED void addTo(float* sums, double share, const std::vector<double>& line) {
  for (std::size_t i = 0; i < line.size(); ++i) sums[i] += static_cast<float>(share * line[i]);
}

/// Values between two rows.
MEMS_STICTION_VECTORIZED void takeBetween(const float* before, const float* behind, double share,
                                          std::vector<double>& line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double value = before[i];
    line[i] = value + share * (behind[i] - value);
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
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const int begin = cells.row_begin[row];
    const int end = cells.row_begin[row + 1];
    if (begin == end) continue;
    const double* const of_row = pressures.data() + begin;
    const std::int32_t* const columns = cells.columns.data() + begin;
    if (is_by_cell) {
      float* const line = filter_->row(static_cast<int>(row));
      for (int i = 0; i < end - begin; ++i) line[columns[i]] = static_cast<float>(of_row[i]);
      continue;
    }
    line_.assign(static_cast<std::size_t>(blocks_.width), 0.0);
    spreadAlong(columns, of_row, end - begin);
    const double behind_share = rows_[row].share / cells_per_block_;
    const double before_share = 1.0 / cells_per_block_ - behind_share;
    addTo(filter_->row(rows_[row].before), before_share, line_);
    addTo(filter_->row(rows_[row].behind), behind_share, line_);
  }
}

void PeriodicCompliance::spreadAlong(const std::int32_t* columns, const double* pressures,
                                     int count) {
  for (int i = 0; i < count; ++i) {
    const Between& at = cols_[static_cast<std::size_t>(columns[i])];
    const double behind = at.share * pressures[i];
    line_[static_cast<std::size_t>(at.before)] += pressures[i] - behind;
    line_[static_cast<std::size_t>(at.behind)] += behind;
  }
}

void PeriodicCompliance::give(const PressedCells& cells, const std::vector<double>& pressures,
                              double contact_modulus, std::vector<double>& ways) {
  spread(cells, pressures);
  filter_->apply(gains_);
  const bool is_by_cell = blocks_ == frame_;
  const double compliance = 1.0 / contact_modulus;
  ways.resize(cells.count());
  line_.resize(static_cast<std::size_t>(blocks_.width));
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const int begin = cells.row_begin[row];
    const int end = cells.row_begin[row + 1];
    if (begin == end) continue;
    double* const of_row = ways.data() + begin;
    const std::int32_t* const columns = cells.columns.data() + begin;
    if (is_by_cell) {
      const float* const line = filter_->row(static_cast<int>(row));
      for (int i = 0; i < end - begin; ++i) of_row[i] = compliance * line[columns[i]];
      continue;
    }
    takeBetween(filter_->row(rows_[row].before), filter_->row(rows_[row].behind), rows_[row].share,
                line_);
    const double* const of_cells = pressures.data() + begin;
    for (int i = 0; i < end - begin; ++i) {
      const Between& at = cols_[static_cast<std::size_t>(columns[i])];
      const double before = line_[static_cast<std::size_t>(at.before)];
      const double behind = line_[static_cast<std::size_t>(at.behind)];
      const double by_blocks = before + at.share * (behind - before);
      of_row[i] = compliance * (by_blocks + short_waves_ * of_cells[i]);
    }
  }
}

}  // namespace mems_stiction
