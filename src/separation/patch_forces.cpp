#include "mems_stiction/separation/patch_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/base/lanes.hpp"
#include "mems_stiction/mechanics/transition.hpp"
#include "mems_stiction/separation/lane_functions.hpp"

namespace mems_stiction {
namespace {

/// Maugis' parameter over Tabor's, for this law: with Maugis' own 1.157 the pull-off force of a sphere lies up to 5 %
/// below that of the 9-3 law, with 0.56 it is that of the law, and in between within 3 % of it and 5 % of his.
constexpr double kMaugisPerTabor = 0.75;
/// What a summit loses by bending even where its neighbours hold on [-], and what it loses more when it stands alone.
constexpr double kLossInCompany = 0.6;
/// P/(Ha A) at which a paraboloid begins to flow: its largest pressure is three times P over the overlapped area.
constexpr double kFlowOnset = 1.0 / 3.0;
/// lambda^1.4 of lambda^3
constexpr double kPowerOfCube = 1.4 / 3.0;

/// Some patches of a sweep by figure, for passes in lanes; behind the last one there are patches of one cell and weight 0.
struct PatchBlock {
  static constexpr std::size_t kMost = 64;
  static_assert(kMost % Lanes::kCount == 0, "lanes end where a block does");

  /// From this place of livePatches() on.
  void gather(const OverlapSweep& sweep, std::size_t place) {
    const std::vector<std::int32_t>& live = sweep.livePatches();
    count = std::min(kMost, live.size() - place);
    for (std::size_t i = 0; i < count; ++i) {
      const OverlapPatch& patch = sweep.patch(live[place + i]);
      cells[i] = patch.cells;
      gap_sum[i] = patch.gap_sum;
      kept[i] = patch.kept;
      first_gap[i] = patch.first_gap;
      summits[i] = patch.summits;
      weight[i] = 1.0;
    }
    for (; count % Lanes::kCount != 0; ++count) {
      cells[count] = summits[count] = 1.0;
      gap_sum[count] = kept[count] = first_gap[count] = weight[count] = 0.0;
    }
  }

  std::size_t count = 0;  ///< a multiple of the lanes
  double cells[kMost];
  double gap_sum[kMost];
  double kept[kMost];
  double first_gap[kMost];
  double summits[kMost];
  double weight[kMost];
};

/// P/(Ha A) with flow, of x = P/(Ha A) without, x beyond the onset [-], of one patch or of several.
template <typename Real>
MEMS_STICTION_INLINE Real flowedFullness(const Real& fullness) {
  // Under a pressure Ha everywhere the edge of the contact sinks in by (4/pi) Ha a/E, and what touches is that much
  // less than the overlap: y + b sqrt(y) = 1 for y = P/(Ha A), b = 8 sqrt(2)/(3 pi^2)/fullness = 0.382/fullness; with
  // 0.385 the curve has no step at the onset.
  const Real b = 2.0 / 3.0 * std::sqrt(kFlowOnset) / fullness;
  const Real root = squareRoot(1.0 + 0.25 * b * b) - 0.5 * b;
  return root * root;
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
  maugis_factor_ = kMaugisPerTabor * kMaugisPerTabor * kMaugisPerTabor * strain * strain / law_.range();
}

template <typename Real>
MEMS_STICTION_INLINE Real PatchForces::elasticLoad(const Real& cells, const Real& gap_sum, const Real& kept,
                                                   double approach) const {
  const Real area = cells * cell_area_;
  const Real load_term = kept + (cells * approach - gap_sum) / squareRoot(cells);
  const Real pressure = load_factor_ * load_term / area;
  const Real depth = approach - gap_sum / cells;
  // round-off may leave none
  return area * law_.pressureInSeries(pressure, greater(depth, Real(std::numeric_limits<double>::min())));
}

PatchLoad PatchForces::loadOf(const OverlapPatch& patch, double approach) const {
  PatchLoad load;
  const double cells = patch.cells;
  load.elastic = elasticLoad(cells, patch.gap_sum, patch.kept, approach);
  const double capacity = hardness_ * cells * cell_area_;
  const double fullness = load.elastic / capacity;
  load.carried = fullness > kFlowOnset ? capacity * flowedFullness(fullness) : load.elastic;
  return load;
}

MEMS_STICTION_VECTORIZED double PatchForces::carried(const OverlapSweep& contacts, double approach) const {
  Lanes sum = 0.0;
  PatchBlock block;
  for (std::size_t place = 0; place < contacts.livePatches().size(); place += PatchBlock::kMost) {
    block.gather(contacts, place);
    for (std::size_t i = 0; i < block.count; i += Lanes::kCount) {
      const Lanes cells = Lanes::load(block.cells + i);
      Lanes load = elasticLoad(cells, Lanes::load(block.gap_sum + i), Lanes::load(block.kept + i), approach);
      const Lanes capacity = hardness_ * cells * cell_area_;
      const Lanes fullness = load / capacity;
      const LaneMask flows = fullness > kFlowOnset;
      if (isAnywhere(flows))
        load = select(flows, capacity * flowedFullness(greater(fullness, Lanes(kFlowOnset))), load);
      sum += Lanes::load(block.weight + i) * load;
    }
  }
  return sum.sum();
}

double PatchForces::pullOffPrefactor(double radius) const {
  return maugis::fittedPullOffPrefactorOfPower(std::pow(maugis_factor_ * radius, kPowerOfCube));
}

MEMS_STICTION_VECTORIZED double PatchForces::bendingFactor(const OverlapSweep& in_reach, double approach) const {
  const double reach = approach + law_.range();
  Lanes weights = 0.0;
  Lanes losses = 0.0;        // of summits in company
  Lanes losses_alone = 0.0;  // what the same lose more when they stand alone, times their weight
  PatchBlock block;
  for (std::size_t place = 0; place < in_reach.livePatches().size(); place += PatchBlock::kMost) {
    block.gather(in_reach, place);
    for (std::size_t i = 0; i < block.count; i += Lanes::kCount) {
      const Lanes cells = Lanes::load(block.cells + i);
      const Lanes depth = reach - Lanes::load(block.gap_sum + i) / cells;
      const Lanes radius = cells * cell_area_ / (4.0 * kPi * depth);
      const Lanes distance = greater(Lanes::load(block.first_gap + i) - approach, Lanes(0.0));
      const Lanes weight = Lanes::load(block.weight + i) * radius * law_.energy(distance);
      const Lanes summits = Lanes::load(block.summits + i);
      const Lanes bend = power(maugis_factor_ * radius / summits, kPowerOfCube);
      const Lanes loss = 1.0 - 0.5 * maugis::fittedPullOffPrefactorOfPower(bend);
      const Lanes lost = weight * loss / squareRoot(summits);
      weights += weight;
      losses += lost;
      losses_alone += lost * weight;
    }
  }
  const double weight = weights.sum();
  if (!(weight > 0.0)) return 1.0;
  return 1.0 - (kLossInCompany * losses.sum() + (1.0 - kLossInCompany) * losses_alone.sum() / weight) / weight;
}

}  // namespace mems_stiction
