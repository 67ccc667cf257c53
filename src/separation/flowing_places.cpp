#include "separation/flowing_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numeric/constants.hpp"
#include "numeric/packet.hpp"

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

/// The pressures of cells which bear `open` more than t D, between 0 and the hardness.
struct Borne {
  double sum = 0.0;
  double rising = 0.0;  ///< how many cells are in between
};

MEMS_STICTION_VECTORIZED Borne borneAt(double by_place, double hardness, const double* open,
                                       std::size_t count) {
  Packet sum = 0.0;
  Packet rising = 0.0;
  const auto take = [&](const Packet& of_cells) {
    const Packet pressure = of_cells + by_place;
    const PacketMask is_pressed = pressure > 0.0;
    const PacketMask is_below = pressure < hardness;
    const Packet most = select(is_below, pressure, Packet(hardness));
    sum += select(is_pressed, most, Packet(0.0));
    rising += select(is_pressed, oneWhere(is_below), Packet(0.0));
  };
  const std::size_t in_packets = count / Packet::kCount * Packet::kCount;
  for (std::size_t i = 0; i < in_packets; i += Packet::kCount) take(Packet::load(open + i));
  if (in_packets < count) {
    constexpr double kApart = -std::numeric_limits<double>::infinity();
    take(Packet::loadFirst(open + in_packets, count - in_packets, kApart));
  }
  return {sum.sum(), rising.sum()};
}

/// p - t r of each cell.
/// @return the lowest and the highest
MEMS_STICTION_VECTORIZED std::pair<double, double> openAt(double stiffness, const double* pressures,
                                                          const double* rises, std::size_t count,
                                                          double* open) {
  Packet lowest = std::numeric_limits<double>::infinity();
  Packet highest = -std::numeric_limits<double>::infinity();
  const std::size_t in_packets = count / Packet::kCount * Packet::kCount;
  for (std::size_t i = 0; i < in_packets; i += Packet::kCount) {
    const Packet of_cells = Packet::load(pressures + i) - stiffness * Packet::load(rises + i);
    lowest = select(of_cells < lowest, of_cells, lowest);
    highest = select(of_cells > highest, of_cells, highest);
    of_cells.store(open + i);
  }
  double low = lowest.smallest();
  double high = highest.largest();
  for (std::size_t i = in_packets; i < count; ++i) {
    open[i] = pressures[i] - stiffness * rises[i];
    low = std::min(low, open[i]);
    high = std::max(high, open[i]);
  }
  return {low, high};
}

MEMS_STICTION_VECTORIZED void movesTo(double by_place, double hardness, const double* open,
                                      const double* pressures, std::size_t count, double* moves) {
  for (std::size_t i = 0; i < count; ++i) {
    const double pressure = open[i] + by_place;
    const double most = pressure < hardness ? pressure : hardness;
    moves[i] = (pressure > 0.0 ? most : 0.0) - pressures[i];
  }
}

/// s of pressures + share moves, from 0 to the hardness. Not in vectors: it takes longer to gather.
/// - @p of_steps s of equal steps of the pressure
void layersUnder(const std::vector<double>& of_steps, double hardness, const double* pressures,
                 double share, const double* moves, std::size_t count, double* layers) {
  const double* const layer = of_steps.data();
  const auto last = static_cast<std::int32_t>(of_steps.size() - 2);
  const double per_pressure = (last + 1) / hardness;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = per_pressure * (pressures[i] + share * moves[i]);
    const std::int32_t before = std::min(static_cast<std::int32_t>(place), last);
    layers[i] = layer[before] + (place - before) * (layer[before + 1] - layer[before]);
  }
}

/// How E falls along the moves at first, and how its slope grows on the way.
struct Descent {
  double fall = 0.0;
  double bend = 0.0;
};

MEMS_STICTION_VECTORIZED Descent descentOf(const double* rises, const double* moves,
                                           const double* yields, const double* layers,
                                           const double* next_layers, std::size_t count) {
  Packet fall = 0.0;
  Packet bend = 0.0;
  const std::size_t in_packets = count / Packet::kCount * Packet::kCount;
  for (std::size_t i = 0; i < in_packets; i += Packet::kCount) {
    const Packet move = Packet::load(moves + i);
    fall += Packet::load(rises + i) * move;
    bend += move *
            (Packet::load(yields + i) + Packet::load(next_layers + i) - Packet::load(layers + i));
  }
  Descent descent = {-fall.sum(), bend.sum()};
  for (std::size_t i = in_packets; i < count; ++i) {
    descent.fall -= rises[i] * moves[i];
    descent.bend += moves[i] * (yields[i] + next_layers[i] - layers[i]);
  }
  return descent;
}

/// Sums over the cells of a step, for the stiffness of the next one.
struct Growth {
  double square_of_moves = 0.0;
  double product = 0.0;  ///< of the moves and by how much rises have grown
  double square = 0.0;   ///< of the latter
};

MEMS_STICTION_VECTORIZED Growth grow(double share, const double* moves, const double* yields,
                                     const double* layers, const double* next_layers,
                                     std::size_t count, double* pressures, double* rises) {
  Packet square_of_moves = 0.0;
  Packet product = 0.0;
  Packet square = 0.0;
  const std::size_t in_packets = count / Packet::kCount * Packet::kCount;
  for (std::size_t i = 0; i < in_packets; i += Packet::kCount) {
    const Packet move = share * Packet::load(moves + i);
    const Packet growth =
        share * Packet::load(yields + i) + Packet::load(next_layers + i) - Packet::load(layers + i);
    (Packet::load(rises + i) + growth).store(rises + i);
    (Packet::load(pressures + i) + move).store(pressures + i);
    square_of_moves += move * move;
    product += move * growth;
    square += growth * growth;
  }
  Growth sums = {square_of_moves.sum(), product.sum(), square.sum()};
  for (std::size_t i = in_packets; i < count; ++i) {
    const double move = share * moves[i];
    const double growth = share * yields[i] + next_layers[i] - layers[i];
    rises[i] += growth;
    pressures[i] += move;
    sums.square_of_moves += move * move;
    sums.product += move * growth;
    sums.square += growth * growth;
  }
  return sums;
}

}  // namespace

void FlowingPlaces::takeCells(const GapField& field, double approach) {
  const int cols = field.cols();
  line_.resize(static_cast<std::size_t>(cols));
  cells_.row_begin.assign(1, 0);
  cells_.columns.clear();
  gaps_.clear();
  if (approach == GapField::kInvalidGap) {  // all of them
    cells_.columns.reserve(static_cast<std::size_t>(field.validCount()));
    gaps_.reserve(static_cast<std::size_t>(field.validCount()));
  }
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

void FlowingPlaces::raise(PeriodicCompliance& bodies) {
  const std::size_t count = gaps_.size();
  bodies.give(cells_, pressures_, contact_modulus_, yields_);
  layers_.resize(count);
  layersUnder(layer_, hardness_, pressures_.data(), 0.0, pressures_.data(), count, layers_.data());
  rises_.resize(count);
  for (std::size_t i = 0; i < count; ++i) rises_[i] = gaps_[i] + yields_[i] + layers_[i];
}

double FlowingPlaces::displacement(double stiffness) {
  open_.resize(gaps_.size());
  const auto [least, most] =
      openAt(stiffness, pressures_.data(), rises_.data(), gaps_.size(), open_.data());
  // of t D
  double low = -most;
  double high = hardness_ - least;
  double place = stiffness * displacement_;
  if (!(place > low && place < high)) place = 0.5 * (low + high);
  for (int search = 0; search < kMostHalvings; ++search) {
    const Borne borne = borneAt(place, hardness_, open_.data(), gaps_.size());
    const double lack = total_ - borne.sum;
    if (std::abs(lack) <= kLoadBalance * total_) break;
    (lack > 0.0 ? low : high) = place;
    const double by_slope = place + lack / borne.rising;
    place = by_slope > low && by_slope < high ? by_slope : 0.5 * (low + high);
  }
  displacement_ = place / stiffness;
  return displacement_;
}

void FlowingPlaces::moveTo(double place, double stiffness) {
  moves_.resize(gaps_.size());
  movesTo(stiffness * place, hardness_, open_.data(), pressures_.data(), gaps_.size(),
          moves_.data());
}

double FlowingPlaces::follow(PeriodicCompliance& bodies, int steps, double stiffness) {
  const std::size_t count = gaps_.size();
  next_layers_.resize(count);
  for (int step = 0; step < steps; ++step) {
    moveTo(displacement(stiffness), stiffness);
    bodies.give(cells_, moves_, contact_modulus_, yields_);
    layersUnder(layer_, hardness_, pressures_.data(), 1.0, moves_.data(), count,
                next_layers_.data());
    const Descent descent = descentOf(rises_.data(), moves_.data(), yields_.data(), layers_.data(),
                                      next_layers_.data(), count);
    if (!(descent.fall > 0.0) || !(descent.bend > 0.0)) break;
    const double share = std::min(1.0, descent.fall / descent.bend);
    if (share < 1.0) {
      layersUnder(layer_, hardness_, pressures_.data(), share, moves_.data(), count,
                  next_layers_.data());
    }
    const Growth growth = grow(share, moves_.data(), yields_.data(), layers_.data(),
                               next_layers_.data(), count, pressures_.data(), rises_.data());
    layers_.swap(next_layers_);
    stiffness =
        step % 2 == 0 ? growth.square_of_moves / growth.product : growth.product / growth.square;
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
  flowed_.resize(gaps_.size());
  for (std::size_t cell = 0; cell < gaps_.size(); ++cell) flowed_[cell] = lost(cell);
  changed_.lower(field, cells_, flowed_);
  const auto begin = cells_.row_begin.begin();
  const auto row = std::upper_bound(begin, cells_.row_begin.end(), static_cast<int>(first)) - begin;
  const int changed_cell = static_cast<int>(row - 1) * field.cols() + cells_.columns[first];
  lowering_ = gaps_[first] + flowed_[first] - changed_.gap(changed_cell);
  std::swap(flowed_cells_, cells_);
  flowed_pressures_.swap(pressures_);
  return true;
}

bool FlowingPlaces::flatten(const GapField& field) {
  pressures_.assign(gaps_.size(), hardness_);
  rises_ = gaps_;
  return takeFlowed(field, field.largestGap());
}

void FlowingPlaces::readRow(int row, double* flowed, double* pressures) const {
  const auto cols = static_cast<std::size_t>(changed_.cols());
  std::fill_n(flowed, cols, 0.0);
  std::fill_n(pressures, cols, 0.0);
  visitRow(row, [&](int col, double lost, double pressure) {
    flowed[col] = lost;
    pressures[col] = pressure;
  });
}

bool FlowingPlaces::press(const GapField& field, const ContactTraction& law, const Press& press) {
  hardness_ = press.hardness;
  total_ = press.load / field.cellArea();
  displacement_ = 0.0;
  is_overloaded_ = false;
  if (!(total_ > 0.0)) return false;
  takeCells(field, press.approach);
  const auto carriesAll = [&] { return total_ < hardness_ * static_cast<double>(gaps_.size()); };
  if (!carriesAll()) takeCells(field, GapField::kInvalidGap);
  is_overloaded_ = !carriesAll();
  if (is_overloaded_) return flatten(field);
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
  raise(by_blocks_);
  double stiffness = follow(by_blocks_, steps, of_a_cell);
  if (block > 1) {
    by_cells_.start(field, 1);
    raise(by_cells_);
    stiffness = follow(by_cells_, chosen::kFlowSteps, stiffness);
  }
  return takeFlowed(field, displacement(stiffness));
}

}  // namespace mems_stiction
