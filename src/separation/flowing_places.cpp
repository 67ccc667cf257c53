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
  cells_.row_begin.assign(1, 0);
  cells_.columns.clear();
  gaps_.clear();
  std::vector<std::int32_t> columns(static_cast<std::size_t>(cols));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line_.data());
    const int count = columnsBetween(0.0, approach, line_.data(), cols, columns.data());
    cells_.columns.insert(cells_.columns.end(), columns.begin(), columns.begin() + count);
    for (int i = 0; i < count; ++i)
      gaps_.push_back(line_[static_cast<std::size_t>(columns[static_cast<std::size_t>(i)])]);
    cells_.row_begin.push_back(static_cast<int>(cells_.columns.size()));
  }
}

void FlowingPlaces::takeLayer(const ContactTraction& law) {
  layer_.resize(chosen::kParts + 1);
  for (std::size_t i = 0; i < layer_.size(); ++i)
    layer_[i] = law.closingUnder(hardness_ * static_cast<double>(i) / chosen::kParts);
}

double FlowingPlaces::layerUnder(double pressure) const {
  const double place = chosen::kParts * (pressure / hardness_);
  const auto before = std::min(static_cast<std::size_t>(place), layer_.size() - 2);
  return layer_[before] +
         (place - static_cast<double>(before)) * (layer_[before + 1] - layer_[before]);
}

void FlowingPlaces::raise(PeriodicCompliance& bodies) {
  bodies.give(cells_, pressures_, contact_modulus_, yields_);
  rises_.resize(gaps_.size());
  layers_.resize(gaps_.size());
  for (std::size_t i = 0; i < gaps_.size(); ++i) {
    layers_[i] = layerUnder(pressures_[i]);
    rises_[i] = gaps_[i] + yields_[i] + layers_[i];
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

void FlowingPlaces::moveTo(double place, double stiffness) {
  moves_.resize(gaps_.size());
  for (std::size_t i = 0; i < gaps_.size(); ++i) {
    const double pressure = pressures_[i] + stiffness * (place - rises_[i]);
    moves_[i] = std::clamp(pressure, 0.0, hardness_) - pressures_[i];
  }
}

double FlowingPlaces::follow(PeriodicCompliance& bodies, int steps, double stiffness) {
  raise(bodies);
  next_layers_.resize(gaps_.size());
  for (int step = 0; step < steps; ++step) {
    moveTo(displacement(stiffness), stiffness);
    bodies.give(cells_, moves_, contact_modulus_, yields_);
    double fall = 0.0;
    double bend = 0.0;
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
      next_layers_[i] = layerUnder(pressures_[i] + moves_[i]);
      fall -= rises_[i] * moves_[i];
      bend += moves_[i] * (yields_[i] + next_layers_[i] - layers_[i]);
    }
    if (!(fall > 0.0) || !(bend > 0.0)) break;
    const double share = std::min(1.0, fall / bend);
    double square_of_moves = 0.0;
    double product = 0.0;
    double square_of_growths = 0.0;
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
      const double move = share * moves_[i];
      pressures_[i] += move;
      const double layer = share == 1.0 ? next_layers_[i] : layerUnder(pressures_[i]);
      const double growth = share * yields_[i] + layer - layers_[i];
      rises_[i] += growth;
      layers_[i] = layer;
      square_of_moves += move * move;
      product += move * growth;
      square_of_growths += growth * growth;
    }
    stiffness = step % 2 == 0 ? square_of_moves / product : product / square_of_growths;
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
  for (std::size_t row = 0; row + 1 < cells_.row_begin.size(); ++row) {
    double* const flowed = flowed_[static_cast<int>(row)];
    double* const pressure = pressure_map_[static_cast<int>(row)];
    for (int i = cells_.row_begin[row]; i < cells_.row_begin[row + 1]; ++i) {
      const auto cell = static_cast<std::size_t>(i);
      pressure[cells_.columns[cell]] = pressures_[cell];
      flowed[cells_.columns[cell]] = lost(cell);
      if (cell == first) changed_cell = static_cast<int>(row) * field.cols() + cells_.columns[cell];
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
  contact_modulus_ = press.contact_modulus;
  takeLayer(law);
  const int longest = std::max(field.rows(), field.cols());
  const int block =
      std::min((longest + chosen::kFlowBlocks - 1) / chosen::kFlowBlocks, chosen::kFlowBlock);
  by_blocks_.start(field, block);
  const double of_a_cell = contact_modulus_ / (kSinkOfCell * std::sqrt(field.cellArea()));
  pressures_.assign(gaps_.size(), 0.0);
  rises_ = gaps_;
  moveTo(displacement(chosen::kFirstStiffness * of_a_cell), chosen::kFirstStiffness * of_a_cell);
  pressures_.swap(moves_);
  const int steps = block == 1 ? chosen::kFlowStepsByCells : chosen::kFlowSteps;
  double stiffness = follow(by_blocks_, steps, of_a_cell);
  if (block > 1) {
    by_cells_.start(field, 1);
    stiffness = follow(by_cells_, 1, stiffness);
  }
  return takeFlowed(field, displacement(stiffness));
}

}  // namespace mems_stiction
