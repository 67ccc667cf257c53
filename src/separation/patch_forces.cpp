#include "separation/patch_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/transition.hpp"
#include "numeric/constants.hpp"
#include "numeric/packet.hpp"
#include "numeric/packet_functions.hpp"

namespace mems_stiction {
namespace {

/// Growth of the area of a cone with its depth, A ~ delta^m: no summit is sharper.
constexpr double kGrowthOfCone = 2.0;
/// lambda over Tabor's parameter, (S8): Maugis' stress is the law's mean one, by the work that it
/// does, 0.548 Gamma/z0.
const double kMaugisPerTabor =
    std::cbrt(9.0 / (2.0 * kPi)) * 64.0 / 9.0 * (1.0 / 5.0 - 2.0 / 11.0 + 1.0 / 17.0);
/// Overlap of a patch that round-off has left none [m].
constexpr double kLeastDepth = std::numeric_limits<double>::min();
/// Pressure of patches that round-off has left none [Pa].
constexpr double kLeastPressure = std::numeric_limits<double>::min();
/// lambda^1.4 of lambda^3
constexpr double kPowerOfCube = 1.4 / 3.0;

/// Some patches of a sweep by figure, for passes in packets; behind the last one there are patches
/// of one cell and weight 0.
struct PatchBlock {
  static constexpr std::size_t kMost = 64;
  static_assert(kMost % Packet::kCount == 0, "packet end where a block does");

  /// From this place of livePatches() on.
  void gather(const OverlapSweep& sweep, std::size_t place) {
    const std::vector<OverlapPatch>& patches = sweep.patches();
    count = std::min(kMost, patches.size() - place);
    for (std::size_t i = 0; i < count; ++i) {
      const OverlapPatch& patch = patches[place + i];
      cells[i] = patch.cells;
      gap_sum[i] = patch.gap_sum;
      merged_term[i] = patch.merged_term;
      first_gap[i] = patch.first_gap;
      summits[i] = patch.summits;
      weight[i] = 1.0;
    }
    for (; count % Packet::kCount != 0; ++count) {
      cells[count] = summits[count] = 1.0;
      gap_sum[count] = merged_term[count] = first_gap[count] = weight[count] = 0.0;
    }
  }

  std::size_t count = 0;  ///< a multiple of the packets
  double cells[kMost];
  double gap_sum[kMost];
  double merged_term[kMost];
  double first_gap[kMost];
  double summits[kMost];
  double weight[kMost];
};

/// P/(Ha A) with flow, of x = P/(Ha A) without, x beyond the onset [-].
MEMS_STICTION_INLINE Packet flowedFullness(const Packet& fullness) {
  // Under a pressure Ha everywhere the edge of the contact sinks in by (4/pi) Ha a/E, and what
  // touches is that much less than the overlap: y + b sqrt(y) = 1 for y = P/(Ha A), b = 8
  // sqrt(2)/(3 pi^2)/fullness = 0.382/fullness; with 0.385 the curve has no step at the onset.
  const Packet b = 2.0 / 3.0 * std::sqrt(PatchForces::kFlowOnset) / fullness;
  const Packet root = squareRoot(1.0 + 0.25 * b * b) - 0.5 * b;
  return root * root;
}

/// 1 - m of a top whose area grows as A ~ delta^m with the depth: 0 of a paraboloid and of all that
/// is sharper, 1 of a punch.
/// - @p depth of its deepest cell [m]
/// - @p mean_depth V/A [m], depth/(m + 1)
MEMS_STICTION_INLINE Packet flatnessOf(const Packet& cells, const Packet& depth,
                                       const Packet& mean_depth) {
  // the summit lies half a cell's share of the depth above the deepest cell
  const Packet growth = depth / mean_depth * cells / (cells - 0.5) - 1.0;
  // n cells tell m within 1/sqrt(n), one cell nothing: what may be a paraboloid is one
  const Packet blur = select(cells > 1.5, 1.0 / squareRoot(cells), Packet(0.5));
  const Packet flatness = greater((1.0 - growth - blur) / (1.0 - blur), Packet(0.0));
  return select(flatness < 1.0, flatness, Packet(1.0));
}

}  // namespace

PatchForces::PatchForces(const ContactSettings& settings, double cell_area, bool flows)
    : law_(settings.interface, settings.lower, settings.upper), cell_area_(cell_area) {
  const ContactPair pair(settings.lower, settings.upper);
  contact_modulus_ = pair.contact_modulus;
  const bool can_flow = flows && settings.deformation == Deformation::kThreeRegimes;
  hardness_ = can_flow ? pair.hardness : std::numeric_limits<double>::infinity();
  load_factor_ = 0.6 * contact_modulus_ * std::sqrt(kPi * cell_area);
  const double strain = law_.workOfAdhesion() / (contact_modulus_ * law_.range());
  // a flat punch of this radius, sqrt(8 pi E Gamma a^3), holds what the strength s of the law does,
  // pi a^2 s
  flaw_length_ = law_.attracts() ? 8.0 / kPi * contact_modulus_ * law_.workOfAdhesion() /
                                       (law_.strength() * law_.strength())
                                 : std::numeric_limits<double>::infinity();
  maugis_factor_ =
      kMaugisPerTabor * kMaugisPerTabor * kMaugisPerTabor * strain * strain / law_.range();
}

MEMS_STICTION_INLINE PatchForces::Loads PatchForces::loadsOf(const Packet& cells,
                                                             const Packet& gap_sum,
                                                             const Packet& merged_term,
                                                             double approach) const {
  const Packet area = cells * cell_area_;
  const Packet load_term = merged_term + volumeTerm(cells, gap_sum, approach);
  // round-off may leave no depth
  const Packet depth = greater(approach - gap_sum / cells, Packet(kLeastDepth));
  const Packet pressure = greater(load_factor_ * load_term / area, Packet(kLeastPressure));
  const Packet shared = law_.pressureInSeries(pressure, depth);
  Loads loads;
  loads.layer_share = 1.0 - shared / pressure;
  loads.elastic = area * shared;
  loads.carried = loads.elastic;
  const Packet capacity = hardness_ * area;
  const Packet fullness = loads.elastic / capacity;
  const PacketMask flows = fullness > PatchForces::kFlowOnset;
  if (isAnywhere(flows)) {
    loads.carried =
        select(flows, capacity * flowedFullness(greater(fullness, Packet(PatchForces::kFlowOnset))),
               loads.elastic);
  }
  return loads;
}

MEMS_STICTION_VECTORIZED void PatchForces::loadsOf(const OverlapSweep& contacts, double approach,
                                                   std::vector<PatchLoad>& loads) const {
  const std::size_t count = contacts.patches().size();
  loads.resize(count);
  PatchBlock block;
  for (std::size_t place = 0; place < count; place += PatchBlock::kMost) {
    block.gather(contacts, place);
    for (std::size_t i = 0; i < block.count; i += Packet::kCount) {
      const Packet cells = Packet::load(block.cells + i);
      const Packet gap_sum = Packet::load(block.gap_sum + i);
      const Loads found = loadsOf(cells, gap_sum, Packet::load(block.merged_term + i), approach);
      const Packet depth = greater(approach - gap_sum / cells, Packet(kLeastDepth));
      const Packet flatness =
          flatnessOf(cells, approach - Packet::load(block.first_gap + i), depth);
      for (std::size_t element = 0; element < Packet::kCount && place + i + element < count;
           ++element) {
        loads[place + i + element] = {found.elastic[element], found.carried[element],
                                      found.layer_share[element], flatness[element]};
      }
    }
  }
}

MEMS_STICTION_VECTORIZED void PatchForces::addContacts(const OverlapSweep& contacts,
                                                       double approach, PlaceSums& sums) const {
  Packet carried = 0.0;
  Packet opened = 0.0;
  PatchBlock block;
  for (std::size_t place = 0; place < contacts.livePatches().size(); place += PatchBlock::kMost) {
    block.gather(contacts, place);
    for (std::size_t i = 0; i < block.count; i += Packet::kCount) {
      const Packet cells = Packet::load(block.cells + i);
      const Packet gap_sum = Packet::load(block.gap_sum + i);
      const Packet weight = Packet::load(block.weight + i);
      const Loads loads = loadsOf(cells, gap_sum, Packet::load(block.merged_term + i), approach);
      carried += weight * loads.carried;
      if (!law_.attracts()) continue;
      // A grows as delta^m, and V/A is delta/(m + 1)
      const Packet depth = greater(approach - gap_sum / cells,
                                   Packet(std::numeric_limits<double>::epsilon() * law_.range()));
      const Packet delta = greater(approach - Packet::load(block.first_gap + i), depth);
      Packet growth = greater(delta / depth - 1.0, Packet(1.0));
      growth = select(growth < kGrowthOfCone, growth, Packet(kGrowthOfCone));
      const Packet work = law_.workOfAdhesion() * cells * cell_area_;
      const Packet load = loads.elastic * 2.0 * depth / work;  // P/(2 pi Gamma R)
      opened += weight * growth * work / delta * 0.5 * (growth - 1.0) * load / (1.0 + load);
    }
  }
  sums.carried += carried.sum();
  sums.opened += opened.sum();
}

double PatchForces::pullOffPrefactor(double radius) const {
  return maugis::fittedPullOffPrefactorOfPower(
      power(Packet(maugis_factor_ * radius), kPowerOfCube)[0]);
}

MEMS_STICTION_VECTORIZED void PatchForces::addReach(const OverlapSweep& in_reach, double approach,
                                                    PlaceSums& sums) const {
  const double reach = in_reach.approach();
  Packet weights = 0.0;
  Packet soft = 0.0;
  Packet losses = 0.0;
  Packet losses_alone = 0.0;
  Packet edge_losses = 0.0;
  Packet edge_slopes = 0.0;
  Packet widths = 0.0;
  const double strongest_gap = law_.strongestGap();
  PatchBlock block;
  for (std::size_t place = 0; place < in_reach.livePatches().size(); place += PatchBlock::kMost) {
    block.gather(in_reach, place);
    for (std::size_t i = 0; i < block.count; i += Packet::kCount) {
      const Packet cells = Packet::load(block.cells + i);
      const Packet first_gap = Packet::load(block.first_gap + i);
      const Packet overlap =
          greater(reach - Packet::load(block.gap_sum + i) / cells, Packet(kLeastDepth));
      const Packet depth = overlap + strongest_gap;
      const Packet radius = cells * cell_area_ / (4.0 * kPi * depth);
      const Packet distance = greater(first_gap - approach, Packet(0.0));
      const Packet weight = Packet::load(block.weight + i) * radius * law_.energy(distance);
      const Packet summits = Packet::load(block.summits + i);
      const Packet cube = maugis_factor_ * radius / summits;
      const Packet bend = power(cube, kPowerOfCube);
      const Packet loss = 1.0 - 0.5 * maugis::fittedPullOffPrefactorOfPower(bend);
      const Packet lost = weight * loss / summits;
      const Packet flatness = flatnessOf(cells, reach - first_gap, overlap);
      weights += weight;
      soft += weight * (1.0 - flatness) * power(cube, 1.0 / 3.0) / kMaugisPerTabor;
      losses += lost;
      losses_alone += lost * weight;
      const Packet exponent = 0.5 * flatness;
      const Packet size = squareRoot(cells * (cell_area_ / kPi)) / flaw_length_;
      const Packet left = weight * power(1.0 + size, -1.0 * exponent);
      widths += weight * size;
      edge_losses += weight - left;
      edge_slopes += left * exponent * size / (1.0 + size);
    }
  }
  sums.weight += weights.sum();
  sums.soft += soft.sum();
  sums.loss += losses.sum();
  sums.loss_alone += losses_alone.sum();
  sums.edge_loss += edge_losses.sum();
  sums.edge_slope += edge_slopes.sum();
  sums.width += widths.sum();
}

}  // namespace mems_stiction
