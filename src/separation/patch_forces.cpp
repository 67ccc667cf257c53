#include "separation/patch_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/transition.hpp"
#include "numeric/constants.hpp"
#include "numeric/lane_functions.hpp"
#include "numeric/lanes.hpp"

namespace mems_stiction {
namespace {

/// P/(Ha A) at which a paraboloid begins to flow: its largest pressure is three times P over the overlapped area.
constexpr double kFlowOnset = 1.0 / 3.0;
/// Growth of the area of a cone with its depth, A ~ delta^m: no summit is sharper.
constexpr double kGrowthOfCone = 2.0;
/// lambda over Tabor's parameter, (S8): Maugis' stress is the law's mean one, by the work that it does, 0.548 Gamma/z0.
const double kMaugisPerTabor = std::cbrt(9.0 / (2.0 * kPi)) * 64.0 / 9.0 * (1.0 / 5.0 - 2.0 / 11.0 + 1.0 / 17.0);
/// Overlap of a patch that round-off has left none [m].
constexpr double kLeastDepth = std::numeric_limits<double>::min();
/// Pressure of patches that round-off has left none [Pa].
constexpr double kLeastPressure = std::numeric_limits<double>::min();
/// lambda^1.4 of lambda^3
constexpr double kPowerOfCube = 1.4 / 3.0;

/// Some patches of a sweep by figure, for passes in lanes; behind the last one there are patches of one cell and weight 0.
struct PatchBlock {
  static constexpr std::size_t kMost = 64;
  static_assert(kMost % Lanes::kCount == 0, "lanes end where a block does");

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
    for (; count % Lanes::kCount != 0; ++count) {
      cells[count] = summits[count] = 1.0;
      gap_sum[count] = merged_term[count] = first_gap[count] = weight[count] = 0.0;
    }
  }

  std::size_t count = 0;  ///< a multiple of the lanes
  double cells[kMost];
  double gap_sum[kMost];
  double merged_term[kMost];
  double first_gap[kMost];
  double summits[kMost];
  double weight[kMost];
};

/// P/(Ha A) with flow, of x = P/(Ha A) without, x beyond the onset [-].
MEMS_STICTION_INLINE Lanes flowedFullness(const Lanes& fullness) {
  // Under a pressure Ha everywhere the edge of the contact sinks in by (4/pi) Ha a/E, and what touches is that much
  // less than the overlap: y + b sqrt(y) = 1 for y = P/(Ha A), b = 8 sqrt(2)/(3 pi^2)/fullness = 0.382/fullness; with
  // 0.385 the curve has no step at the onset.
  const Lanes b = 2.0 / 3.0 * std::sqrt(kFlowOnset) / fullness;
  const Lanes root = squareRoot(1.0 + 0.25 * b * b) - 0.5 * b;
  return root * root;
}

/// 1 - m of a top whose area grows as A ~ delta^m with the depth: 0 of a paraboloid and of all that is sharper, 1 of a punch.
/// - @p depth of its deepest cell [m]
/// - @p mean_depth V/A [m], depth/(m + 1)
MEMS_STICTION_INLINE Lanes flatnessOf(const Lanes& cells, const Lanes& depth, const Lanes& mean_depth) {
  // the summit lies half a cell's share of the depth above the deepest cell
  const Lanes growth = depth / mean_depth * cells / (cells - 0.5) - 1.0;
  // n cells tell m within 1/sqrt(n), one cell nothing: what may be a paraboloid is one
  const Lanes blur = select(cells > 1.5, 1.0 / squareRoot(cells), Lanes(0.5));
  const Lanes flatness = greater((1.0 - growth - blur) / (1.0 - blur), Lanes(0.0));
  return select(flatness < 1.0, flatness, Lanes(1.0));
}

}  // namespace

PatchForces::PatchForces(const ContactSettings& settings, double cell_area, bool flows)
    : law_(settings.interface), cell_area_(cell_area) {
  const ContactPair pair(settings.lower, settings.upper);
  contact_modulus_ = pair.contact_modulus;
  const bool can_flow = flows && settings.deformation == Deformation::kThreeRegimes;
  hardness_ = can_flow ? pair.hardness : std::numeric_limits<double>::infinity();
  load_factor_ = 0.6 * contact_modulus_ * std::sqrt(kPi * cell_area);
  const double strain = law_.workOfAdhesion() / (contact_modulus_ * law_.range());
  // a flat punch of this radius, sqrt(8 pi E Gamma a^3), holds what the strength s of the law does, pi a^2 s
  flaw_length_ = law_.attracts()
                     ? 8.0 / kPi * contact_modulus_ * law_.workOfAdhesion() / (law_.strength() * law_.strength())
                     : std::numeric_limits<double>::infinity();
  maugis_factor_ = kMaugisPerTabor * kMaugisPerTabor * kMaugisPerTabor * strain * strain / law_.range();
}

MEMS_STICTION_INLINE PatchForces::Loads PatchForces::loadsOf(const Lanes& cells, const Lanes& gap_sum,
                                                             const Lanes& merged_term, double approach) const {
  const Lanes area = cells * cell_area_;
  const Lanes load_term = merged_term + volumeTerm(cells, gap_sum, approach);
  // round-off may leave no depth
  const Lanes depth = greater(approach - gap_sum / cells, Lanes(kLeastDepth));
  const Lanes pressure = greater(load_factor_ * load_term / area, Lanes(kLeastPressure));
  const Lanes shared = law_.pressureInSeries(pressure, depth);
  Loads loads;
  loads.layer_share = 1.0 - shared / pressure;
  loads.elastic = area * shared;
  loads.carried = loads.elastic;
  const Lanes capacity = hardness_ * area;
  const Lanes fullness = loads.elastic / capacity;
  const LaneMask flows = fullness > kFlowOnset;
  if (isAnywhere(flows)) {
    loads.carried = select(flows, capacity * flowedFullness(greater(fullness, Lanes(kFlowOnset))), loads.elastic);
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
    for (std::size_t i = 0; i < block.count; i += Lanes::kCount) {
      const Lanes cells = Lanes::load(block.cells + i);
      const Lanes gap_sum = Lanes::load(block.gap_sum + i);
      const Loads found = loadsOf(cells, gap_sum, Lanes::load(block.merged_term + i), approach);
      const Lanes depth = greater(approach - gap_sum / cells, Lanes(kLeastDepth));
      const Lanes flatness = flatnessOf(cells, approach - Lanes::load(block.first_gap + i), depth);
      for (std::size_t lane = 0; lane < Lanes::kCount && place + i + lane < count; ++lane) {
        loads[place + i + lane] = {found.elastic[lane], found.carried[lane], found.layer_share[lane], flatness[lane]};
      }
    }
  }
}

MEMS_STICTION_VECTORIZED void PatchForces::addContacts(const OverlapSweep& contacts, double approach,
                                                       PlaceSums& sums) const {
  Lanes carried = 0.0;
  Lanes opened = 0.0;
  PatchBlock block;
  for (std::size_t place = 0; place < contacts.livePatches().size(); place += PatchBlock::kMost) {
    block.gather(contacts, place);
    for (std::size_t i = 0; i < block.count; i += Lanes::kCount) {
      const Lanes cells = Lanes::load(block.cells + i);
      const Lanes gap_sum = Lanes::load(block.gap_sum + i);
      const Lanes weight = Lanes::load(block.weight + i);
      const Loads loads = loadsOf(cells, gap_sum, Lanes::load(block.merged_term + i), approach);
      carried += weight * loads.carried;
      if (!law_.attracts()) continue;
      // A grows as delta^m, and V/A is delta/(m + 1)
      const Lanes depth =
          greater(approach - gap_sum / cells, Lanes(std::numeric_limits<double>::epsilon() * law_.range()));
      const Lanes delta = greater(approach - Lanes::load(block.first_gap + i), depth);
      Lanes growth = greater(delta / depth - 1.0, Lanes(1.0));
      growth = select(growth < kGrowthOfCone, growth, Lanes(kGrowthOfCone));
      const Lanes work = law_.workOfAdhesion() * cells * cell_area_;
      const Lanes load = loads.elastic * 2.0 * depth / work;  // P/(2 pi Gamma R)
      opened += weight * growth * work / delta * 0.5 * (growth - 1.0) * load / (1.0 + load);
    }
  }
  sums.carried += carried.sum();
  sums.opened += opened.sum();
}

double PatchForces::pullOffPrefactor(double radius) const {
  return maugis::fittedPullOffPrefactorOfPower(power(Lanes(maugis_factor_ * radius), kPowerOfCube)[0]);
}

MEMS_STICTION_VECTORIZED void PatchForces::addReach(const OverlapSweep& in_reach, double approach,
                                                    PlaceSums& sums) const {
  const double reach = in_reach.approach();
  Lanes weights = 0.0;
  Lanes soft = 0.0;
  Lanes losses = 0.0;
  Lanes losses_alone = 0.0;
  Lanes edge_losses = 0.0;
  Lanes edge_slopes = 0.0;
  Lanes widths = 0.0;
  PatchBlock block;
  for (std::size_t place = 0; place < in_reach.livePatches().size(); place += PatchBlock::kMost) {
    block.gather(in_reach, place);
    for (std::size_t i = 0; i < block.count; i += Lanes::kCount) {
      const Lanes cells = Lanes::load(block.cells + i);
      const Lanes first_gap = Lanes::load(block.first_gap + i);
      const Lanes overlap = greater(reach - Lanes::load(block.gap_sum + i) / cells, Lanes(kLeastDepth));
      const Lanes depth = overlap + law_.strongestGap();
      const Lanes radius = cells * cell_area_ / (4.0 * kPi * depth);
      const Lanes distance = greater(first_gap - approach, Lanes(0.0));
      const Lanes weight = Lanes::load(block.weight + i) * radius * law_.energy(distance);
      const Lanes summits = Lanes::load(block.summits + i);
      const Lanes cube = maugis_factor_ * radius / summits;
      const Lanes bend = power(cube, kPowerOfCube);
      const Lanes loss = 1.0 - 0.5 * maugis::fittedPullOffPrefactorOfPower(bend);
      const Lanes lost = weight * loss / summits;
      const Lanes flatness = flatnessOf(cells, reach - first_gap, overlap);
      weights += weight;
      soft += weight * (1.0 - flatness) * power(cube, 1.0 / 3.0) / kMaugisPerTabor;
      losses += lost;
      losses_alone += lost * weight;
      const Lanes exponent = 0.5 * flatness;
      const Lanes size = squareRoot(cells * (cell_area_ / kPi)) / flaw_length_;
      const Lanes left = weight * power(1.0 + size, -1.0 * exponent);
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
