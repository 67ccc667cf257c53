#include "evaluation_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "numeric/packet.hpp"
#include "numeric/packet_functions.hpp"

namespace mems_stiction {
namespace evaluation_rows {
namespace {

/// Cells that are worked on together: their intermediate values stay in the first cache.
constexpr int kTile = 256;
constexpr int kPacket = static_cast<int>(Packet::kCount);
static_assert(kTile % kPacket == 0, "tiles are whole packet");

/// Residual from which on a secant is worth its while, of 8 Gamma/(3 z0).
constexpr double kSecantShare = 0.05;

struct Tile {
  alignas(64) double gaps[kTile];
  alignas(64) double traction[kTile];
  alignas(64) double slope[kTile];
  alignas(64) double energy[kTile];
};

MEMS_STICTION_VECTORIZED void setGaps(int count, double level, const double* relief, double length,
                                      const double* displacement, const float* step, double* gaps) {
  for (int i = 0; i < count; ++i) {
    gaps[i] = level + relief[i] - (displacement[i] + length * static_cast<double>(step[i]));
  }
}

/// How far the surfaces are from each other. @return the lowest gap of the tile
MEMS_STICTION_VECTORIZED double addGaps(int count, double contact_gap, Tile& tile, Sums& sums) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (int i = count; i % kPacket != 0; ++i) tile.gaps[i] = infinity;
  Packet gap, contacts;
  Packet lowest(infinity);
  for (int i = 0; i < count; i += kPacket) {
    const Packet here = Packet::load(tile.gaps + i);
    gap += select(here < infinity, here, 0.0);
    contacts += select(here < contact_gap, Packet(1.0), 0.0);
    lowest = select(here < lowest, here, lowest);
  }
  sums.gap += gap.sum();
  sums.contacts += contacts.sum();
  const double lowest_gap = lowest.smallest();
  sums.lowest_gap = std::min(sums.lowest_gap, lowest_gap);
  return lowest_gap;
}

/// The traction against which u moves, less what is fixed, and what that adds to the energy.
void addFixed(int count, const float* fixed, const double* displacement, Tile& tile) {
  for (int i = 0; i < count; ++i) {
    const auto here = static_cast<double>(fixed[i]);
    tile.traction[i] -= here;
    tile.energy[i] += here * displacement[i];
  }
}

/// Residuals into `arrays` and sums in fixed packets; the tile is filled up with what adds nothing.
MEMS_STICTION_VECTORIZED void addTile(int count, double length, const RowArrays& arrays, Tile& tile,
                                      Sums& sums) {
  alignas(64) double displacement[kTile];
  alignas(64) double elastic[kTile];
  alignas(64) double work[kTile];
  for (int i = 0; i < count; ++i) {
    const double move = length * static_cast<double>(arrays.step[i]);
    const double further = length * static_cast<double>(arrays.step_traction[i]);
    displacement[i] = arrays.displacement[i] + move;
    elastic[i] = arrays.elastic_traction[i] + further;
    // with s K u for u K s: else what rounding leaves in K s would be weighed with all of u
    work[i] = arrays.displacement[i] * arrays.elastic_traction[i] +
              move * (arrays.elastic_traction[i] + elastic[i]);
  }
  if (arrays.fixed != nullptr) addFixed(count, arrays.fixed, displacement, tile);
  int end = count;
  for (; end % kPacket != 0; ++end) {
    work[end] = tile.slope[end] = tile.energy[end] = 0.0;
    tile.traction[end] = tile.traction[count - 1];
    elastic[end] = elastic[count - 1];
  }
  Packet traction, elastic_energy, energy, positive, residual, squared;
  Packet highest(sums.highest);
  Packet lowest(sums.lowest);
  for (int i = 0; i < end; i += kPacket) {
    Packet t = Packet::load(tile.traction + i);
    const Packet dt = Packet::load(tile.slope + i);
    const Packet ku = Packet::load(elastic + i);
    const Packet r = t - ku;
    elastic_energy += Packet::load(work + i);
    energy += Packet::load(tile.energy + i);
    positive += select(dt > 0.0, dt, 0.0);
    highest = select(r > highest, r, highest);
    lowest = select(r < lowest, r, lowest);
    r.store(elastic + i);
    Packet counted = r;
    if (i + kPacket > count) {
      const auto left = static_cast<std::size_t>(count - i);
      t = Packet::loadFirst(tile.traction + i, left, 0.0);
      counted = Packet::loadFirst(elastic + i, left, 0.0);
    }
    traction += t;
    residual += counted;
    squared += counted * counted;
  }
  for (int i = 0; i < count; ++i) arrays.residual[i] = static_cast<float>(elastic[i]);
  if (arrays.slope != nullptr) {
    for (int i = 0; i < count; ++i) arrays.slope[i] = static_cast<float>(tile.slope[i]);
  }
  sums.traction += traction.sum();
  sums.elastic += elastic_energy.sum();
  sums.energy += energy.sum();
  sums.positive_slope += positive.sum();
  sums.residual += residual.sum();
  sums.residual_squared += squared.sum();
  sums.highest = highest.largest();
  sums.lowest = lowest.smallest();
}

/// Where repulsion and elastic traction differ, the slope of the line between both: the tangent of
/// (z0/g)^9 would take a step for each factor of three in the traction.
MEMS_STICTION_VECTORIZED void useSecants(const TractionLaw& law, int count, double length,
                                         const RowArrays& arrays, Tile& tile) {
  const double least = kSecantShare * law.stress();
  for (int i = 0; i < count; i += kPacket) {
    const Packet gap = Packet::load(tile.gaps + i);  // filled up with what is infinite
    const PacketMask repels = gap < law.contactGap();
    if (!isAnywhere(repels)) continue;
    const auto left = static_cast<std::size_t>(std::min(count - i, kPacket));
    const auto take = [&](const auto* from) __attribute__((always_inline)) {
      return left == Packet::kCount ? Packet::load(from) : Packet::loadFirst(from, left, 0.0);
    };
    const Packet traction = take(tile.traction + i);
    const Packet slope = take(tile.slope + i);
    const Packet fixed = arrays.fixed != nullptr ? take(arrays.fixed + i) : Packet();
    const Packet elastic = arrays.mean + fixed + take(arrays.elastic_traction + i) +
                           length * take(arrays.step_traction + i);
    const Packet wanted = select(elastic < 0.0, elastic, Packet());
    const Packet missed = select(repels, greater(traction - wanted, wanted - traction), Packet());
    const PacketMask is_missed = missed > least;
    if (!isAnywhere(is_missed)) continue;
    const Packet secant = law.secant(gap, traction, wanted);
    select(select(is_missed, secant, Packet()) > 0.0, secant, slope)
        .storeFirst(left, tile.slope + i);
  }
}

RowArrays shifted(const RowArrays& arrays, int cells) {
  return {arrays.displacement + cells,
          arrays.elastic_traction + cells,
          arrays.step + cells,
          arrays.step_traction + cells,
          arrays.residual + cells,
          arrays.slope == nullptr ? nullptr : arrays.slope + cells,
          arrays.fixed == nullptr ? nullptr : arrays.fixed + cells,
          arrays.mean};
}

}  // namespace

Sums& Sums::operator+=(const Sums& other) {
  traction += other.traction;
  elastic += other.elastic;
  energy += other.energy;
  positive_slope += other.positive_slope;
  residual += other.residual;
  residual_squared += other.residual_squared;
  highest = std::max(highest, other.highest);
  lowest = std::min(lowest, other.lowest);
  gap += other.gap;
  contacts += other.contacts;
  lowest_gap = std::min(lowest_gap, other.lowest_gap);
  return *this;
}

Sums evaluate(const TractionLaw& law, int count, double level, const double* relief, double length,
              const RowArrays& arrays) {
  Sums sums;
  Tile tile;
  for (int begin = 0; begin < count; begin += kTile) {
    const int size = std::min(kTile, count - begin);
    const RowArrays part = shifted(arrays, begin);
    setGaps(size, level, relief + begin, length, part.displacement, part.step, tile.gaps);
    law.atRow(size, tile.gaps, tile.traction, tile.slope, tile.energy);
    const double lowest_gap = addGaps(size, law.contactGap(), tile, sums);
    if (lowest_gap < law.contactGap()) useSecants(law, size, length, part, tile);
    addTile(size, length, part, tile, sums);
  }
  return sums;
}

Sums evaluateFree(int count, double length, const RowArrays& arrays) {
  Sums sums;
  Tile tile;
  std::fill_n(tile.traction, kTile, 0.0);
  std::fill_n(tile.slope, kTile, 0.0);
  std::fill_n(tile.energy, kTile, 0.0);
  for (int begin = 0; begin < count; begin += kTile) {
    addTile(std::min(kTile, count - begin), length, shifted(arrays, begin), tile, sums);
  }
  return sums;
}

}  // namespace evaluation_rows
}  // namespace mems_stiction
