#include "separation/flowing_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/constants.hpp"
#include "numeric/vectorized.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// A cell under an even pressure p sinks in by this times p pitch/E in its middle, by Love's
/// solution.
const double kSinkOfCell = 4.0 / kPi * std::log(1.0 + std::sqrt(2.0));
/// The load is met to this share of it.
constexpr double kLoadBalance = 1e-9;
/// Of the search for it, each step of which halves what is left at least.
constexpr int kMostHalvings = 60;

/// So many blocks that a transform is quick.
int blocksOf(int cells, int cells_per_side) {
  const int wanted = (cells + cells_per_side - 1) / cells_per_side;
  for (int count = std::min(wanted, chosen::kParts); count > 1; --count) {
    if (cv::getOptimalDFTSize(count) == count) return count;
  }
  return 1;
}

/// 2/(E q) of each number of a transform of blocks as cv::dft packs it: real and imaginary parts
/// side by side along rows, but one above the other in columns without a partner.
void packedCompliance(const cv::Size& blocks, double width, double height, double contact_modulus,
                      cv::Mat1d& compliance) {
  const auto waveOf = [](int index, double length) { return 2.0 * kPi * index / length; };
  compliance.create(blocks);
  for (int row = 0; row < blocks.height; ++row) {
    const double along_column = waveOf(std::min(row, blocks.height - row), height);
    const double alone = waveOf((row + 1) / 2, height);
    double* const line = compliance[row];
    for (int col = 0; col < blocks.width; ++col) {
      const bool is_alone = col == 0 || (col == blocks.width - 1 && blocks.width % 2 == 0);
      const double q_x = waveOf((col + 1) / 2, width);
      const double q_y = is_alone ? alone : along_column;
      line[col] = 2.0 / (contact_modulus * std::sqrt(q_x * q_x + q_y * q_y));
    }
  }
  compliance(0, 0) = 0.0;
}

/// Sum of stiffness (displacement - x) between 0 and the hardness, and how many cells are in
/// between.
struct Borne {
  double sum = 0.0;
  double rising = 0.0;
};

MEMS_STICTION_VECTORIZED Borne borneAt(double displacement, double stiffness, double hardness,
                                       const double* rises, const double* pressures,
                                       std::size_t count) {
  Borne borne;
  for (std::size_t i = 0; i < count; ++i) {
    const double pressure = pressures[i] + stiffness * (displacement - rises[i]);
    borne.sum += std::min(std::max(pressure, 0.0), hardness);
    borne.rising += pressure > 0.0 && pressure < hardness ? 1.0 : 0.0;
  }
  return borne;
}

}  // namespace

void FlowingPlaces::takeCells(const GapField& field, double approach) {
  const int cols = field.cols();
  line_.resize(static_cast<std::size_t>(cols));
  row_begin_.assign(1, 0);
  columns_.clear();
  gaps_.clear();
  std::vector<std::int32_t> columns(static_cast<std::size_t>(cols));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line_.data());
    const int count = columnsBetween(0.0, approach, line_.data(), cols, columns.data());
    columns_.insert(columns_.end(), columns.begin(), columns.begin() + count);
    for (int i = 0; i < count; ++i)
      gaps_.push_back(line_[static_cast<std::size_t>(columns[static_cast<std::size_t>(i)])]);
    row_begin_.push_back(static_cast<int>(columns_.size()));
  }
}

std::vector<FlowingPlaces::Between> FlowingPlaces::betweenBlocks(int cells, int blocks) {
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

void FlowingPlaces::takeBlocks(const GapField& field, double contact_modulus, int cells_per_side) {
  const cv::Size blocks(blocksOf(field.cols(), cells_per_side),
                        blocksOf(field.rows(), cells_per_side));
  rows_ = betweenBlocks(field.rows(), blocks.height);
  cols_ = betweenBlocks(field.cols(), blocks.width);
  is_by_cell_ = blocks.width == field.cols() && blocks.height == field.rows();
  cells_per_block_ = static_cast<double>(field.cellCount()) / blocks.area();
  packedCompliance(blocks, field.cols() * field.pitchX(), field.rows() * field.pitchY(),
                   contact_modulus, compliance_);
  // the mean of 2/(E q) over the waves from those of blocks to those of cells
  const double pitch = std::sqrt(field.cellArea());
  short_compliance_ =
      is_by_cell_
          ? 0.0
          : 4.0 * pitch / (kPi * contact_modulus * (1.0 + 1.0 / std::sqrt(cells_per_block_)));
}

void FlowingPlaces::spread(const std::vector<double>& pressures) {
  blocks_.create(compliance_.size());
  blocks_ = 0.0;
  const double share = 1.0 / cells_per_block_;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const Between& at_row = rows_[row];
    double* const before = blocks_[at_row.before];
    double* const behind = blocks_[at_row.behind];
    for (int i = row_begin_[row]; i < row_begin_[row + 1]; ++i) {
      const auto cell = static_cast<std::size_t>(i);
      const Between& at = cols_[static_cast<std::size_t>(columns_[cell])];
      const double pressure = share * pressures[cell];
      const double lower = at_row.share * pressure;
      const double upper = pressure - lower;
      before[at.before] += upper * (1.0 - at.share);
      before[at.behind] += upper * at.share;
      behind[at.before] += lower * (1.0 - at.share);
      behind[at.behind] += lower * at.share;
    }
  }
}

void FlowingPlaces::yield(const std::vector<double>& pressures, std::vector<double>& yields) {
  spread(pressures);
  cv::dft(blocks_, spectrum_);
  cv::multiply(spectrum_, compliance_, spectrum_);
  cv::dft(spectrum_, yield_of_blocks_, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  if (!is_by_cell_) yield_of_blocks_ -= short_compliance_ * blocks_;
  const double own = short_compliance_ + compliance_of_law_;
  yields.resize(pressures.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const Between& at_row = rows_[row];
    const double* const before = yield_of_blocks_[at_row.before];
    const double* const behind = yield_of_blocks_[at_row.behind];
    for (int i = row_begin_[row]; i < row_begin_[row + 1]; ++i) {
      const auto cell = static_cast<std::size_t>(i);
      const Between& at = cols_[static_cast<std::size_t>(columns_[cell])];
      const double upper = before[at.before] + at.share * (before[at.behind] - before[at.before]);
      const double lower = behind[at.before] + at.share * (behind[at.behind] - behind[at.before]);
      yields[cell] = upper + at_row.share * (lower - upper) + own * pressures[cell];
    }
  }
}

double FlowingPlaces::displacement(double stiffness) const {
  const auto begin = rises_.begin();
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < rises_.size(); ++i) {
    const double open = begin[static_cast<std::ptrdiff_t>(i)] - pressures_[i] / stiffness;
    low = std::min(low, open);
    high = std::max(high, open + hardness_ / stiffness);
  }
  double displacement = 0.5 * (low + high);
  for (int search = 0; search < kMostHalvings; ++search) {
    const Borne borne = borneAt(displacement, stiffness, hardness_, rises_.data(),
                                pressures_.data(), rises_.size());
    const double lack = total_ - borne.sum;
    if (std::abs(lack) <= kLoadBalance * total_) break;
    (lack > 0.0 ? low : high) = displacement;
    const double by_slope = displacement + lack / (stiffness * borne.rising);
    displacement = by_slope > low && by_slope < high ? by_slope : 0.5 * (low + high);
  }
  return displacement;
}

double FlowingPlaces::solve(double stiffness) {
  const std::size_t count = gaps_.size();
  rises_ = gaps_;
  pressures_.assign(count, 0.0);
  const auto pressureAt = [&](std::size_t i, double place, double per_length) {
    return std::clamp(pressures_[i] + per_length * (place - rises_[i]), 0.0, hardness_);
  };
  const double first = chosen::kFirstStiffness * stiffness;
  const double start = displacement(first);
  for (std::size_t i = 0; i < count; ++i) pressures_[i] = pressureAt(i, start, first);
  yield(pressures_, yields_);
  for (std::size_t i = 0; i < count; ++i) rises_[i] = gaps_[i] + yields_[i];
  moves_.resize(count);
  for (int step = 0; step < chosen::kFlowSteps; ++step) {
    const double place = displacement(stiffness);
    double fall = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      moves_[i] = pressureAt(i, place, stiffness) - pressures_[i];
      fall -= rises_[i] * moves_[i];
      square += moves_[i] * moves_[i];
    }
    yield(moves_, yields_);
    double bend = 0.0;
    double square_of_yields = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      bend += moves_[i] * yields_[i];
      square_of_yields += yields_[i] * yields_[i];
    }
    if (!(fall > 0.0) || !(bend > 0.0)) break;
    const double share = std::min(1.0, fall / bend);
    for (std::size_t i = 0; i < count; ++i) {
      pressures_[i] += share * moves_[i];
      rises_[i] += share * yields_[i];
    }
    stiffness = step % 2 == 0 ? square / bend : bend / square_of_yields;
  }
  return stiffness;
}

bool FlowingPlaces::takeFlowed(const GapField& field, double displacement) {
  const auto lost = [&](std::size_t cell) {
    const bool is_full = pressures_[cell] >= (1.0 - kLoadBalance) * hardness_;
    return is_full ? std::max(displacement - rises_[cell], 0.0) : 0.0;
  };
  std::size_t first = 0;
  while (first < gaps_.size() && !(lost(first) > 0.0)) ++first;
  if (first == gaps_.size()) return false;
  flowed_.create(field.rows(), field.cols());
  pressure_map_.create(field.rows(), field.cols());
  flowed_ = 0.0;
  pressure_map_ = 0.0;
  int changed_cell = 0;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    double* const flowed = flowed_[static_cast<int>(row)];
    double* const pressure = pressure_map_[static_cast<int>(row)];
    for (int i = row_begin_[row]; i < row_begin_[row + 1]; ++i) {
      const auto cell = static_cast<std::size_t>(i);
      pressure[columns_[cell]] = pressures_[cell];
      flowed[columns_[cell]] = lost(cell);
      if (cell == first) changed_cell = static_cast<int>(row) * field.cols() + columns_[cell];
    }
  }
  changed_.lower(field, flowed_);
  lowering_ = gaps_[first] + lost(first) - changed_.gap(changed_cell);
  return true;
}

bool FlowingPlaces::press(const GapField& field, const ContactTraction& law, const Press& press) {
  hardness_ = press.hardness;
  total_ = press.load / field.cellArea();
  takeCells(field, press.approach);
  if (!(total_ > 0.0) || !(total_ < hardness_ * static_cast<double>(gaps_.size()))) return false;
  compliance_of_law_ = law.closingUnder(hardness_) / hardness_;
  takeBlocks(field, press.contact_modulus, chosen::kFlowBlock);
  const double stiffness =
      solve(press.contact_modulus / (kSinkOfCell * std::sqrt(field.cellArea())));
  takeBlocks(field, press.contact_modulus, 1);
  yield(pressures_, yields_);
  for (std::size_t i = 0; i < gaps_.size(); ++i) rises_[i] = gaps_[i] + yields_[i];
  return takeFlowed(field, displacement(stiffness));
}

}  // namespace mems_stiction
