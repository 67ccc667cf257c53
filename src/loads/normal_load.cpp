#include "mems_stiction/loads/normal_load.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/base/lanes.hpp"
#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {
namespace {

/// A bucket may stand for its cells when its gap is at least this many times its width.
constexpr double kGapsPerWidth = 12.0;
/// Buckets next to the contact whose cells are summed one by one: enough for the Taylor series beyond, and, while they
/// are wide, as many as reach the cut-off, where the integrand has a kink.
constexpr std::size_t kTailLevel = 4;
static_assert(1 << kTailLevel == GapOrder::kBucketsPerTailBucket, "the tail's buckets are a level of the pyramid");
constexpr double kFewestNearBuckets = kGapsPerWidth;
constexpr double kMostNearBuckets = 64.0;

GapMoments merged(const GapMoments& a, const GapMoments& b) {
  if (a.count == 0.0) return b;
  if (b.count == 0.0) return a;
  GapMoments sum;
  sum.count = a.count + b.count;
  sum.mean = (a.count * a.mean + b.count * b.mean) / sum.count;
  const double distance = b.mean - a.mean;
  sum.variance =
      (a.count * a.variance + b.count * b.variance + a.count * b.count / sum.count * distance * distance) / sum.count;
  return sum;
}

/// The denominator of (2), of one gap or of several; gaps below the cut-off count as the cut-off.
template <typename Real>
MEMS_STICTION_INLINE Real cubedDistance(const Real& gap, double cutoff) {
  const Real distance = select(gap > cutoff, gap, Real(cutoff));
  return distance * distance * distance;
}

/// The denominator of (3), of one gap or of several.
template <typename Real>
MEMS_STICTION_INLINE Real squaredDistance(const Real& gap, double insulator) {
  const Real distance = gap + insulator;
  return distance * distance;
}

}  // namespace

CellForces::CellForces(const InterfaceOptions& interface, double voltage, double cell_area)
    : van_der_waals_factor_(interface.hamaker_constant * cell_area / (6.0 * kPi)),
      cutoff_(interface.cutoff_distance),
      electrostatic_factor_(0.5 * kVacuumPermittivity * cell_area * voltage * voltage),
      insulator_(interface.insulator_thickness / interface.insulator_relative_permittivity) {}

double CellForces::vanDerWaals(double gap) const { return van_der_waals_factor_ / cubedDistance(gap, cutoff_); }

double CellForces::electrostatic(double gap) const {
  if (!hasElectrostatic()) return 0.0;
  return electrostatic_factor_ / squaredDistance(gap, insulator_);
}

double CellForces::electrostaticInContact() const { return electrostatic(0.0); }

MEMS_STICTION_VECTORIZED void CellForces::addCells(const OrderedCell* cells, std::size_t count, double approach,
                                                   NormalLoad& load) const {
  Lanes inverse_cubes = 0.0;
  Lanes inverse_squares = 0.0;
  const std::size_t in_lanes = count / Lanes::kCount * Lanes::kCount;
  for (std::size_t i = 0; i < in_lanes; i += Lanes::kCount) {
    const Lanes gap = Lanes(cells[i].gap, cells[i + 1].gap, cells[i + 2].gap, cells[i + 3].gap) - approach;
    inverse_cubes += 1.0 / cubedDistance(gap, cutoff_);
    inverse_squares += 1.0 / squaredDistance(gap, insulator_);
  }
  load.van_der_waals += van_der_waals_factor_ * inverse_cubes.sum();
  if (hasElectrostatic()) load.electrostatic += electrostatic_factor_ * inverse_squares.sum();
  for (std::size_t i = in_lanes; i < count; ++i) {
    load.van_der_waals += vanDerWaals(cells[i].gap - approach);
    load.electrostatic += electrostatic(cells[i].gap - approach);
  }
}

double CellForces::vanDerWaals(const GapMoments& gaps, double approach) const {
  const double gap = gaps.mean - approach;
  if (gap < cutoff_) return gaps.count * vanDerWaals(gap);
  return gaps.count * vanDerWaals(gap) * (1.0 + 6.0 * gaps.variance / (gap * gap));
}

double CellForces::electrostatic(const GapMoments& gaps, double approach) const {
  if (!hasElectrostatic()) return 0.0;
  const double distance = gaps.mean - approach + insulator_;
  return gaps.count * electrostatic_factor_ / (distance * distance) *
         (1.0 + 3.0 * gaps.variance / (distance * distance));
}

void GapLoads::prepare(const GapOrder& order) {
  order_ = &order;
  std::size_t level_count = 1;
  while ((order.bucketCount() >> level_count) > 0) ++level_count;
  coarser_levels_.resize(level_count - 1);
  for (std::size_t level = 1; level < level_count; ++level) {
    const std::vector<GapMoments>& finer = momentsOf(level - 1);
    std::vector<GapMoments>& coarser = coarser_levels_[level - 1];
    coarser.resize((finer.size() + 1) / 2);
    for (std::size_t i = 0; i < coarser.size(); ++i) {
      coarser[i] = 2 * i + 1 < finer.size() ? merged(finer[2 * i], finer[2 * i + 1]) : finer[2 * i];
    }
    if (1 << level == GapOrder::kBucketsPerTailBucket) {
      coarser.insert(coarser.end(), order.tailMoments().begin(), order.tailMoments().end());
    }
  }
}

const std::vector<GapMoments>& GapLoads::momentsOf(std::size_t level) const {
  return level == 0 ? order_->orderedMoments() : coarser_levels_[level - 1];
}

MEMS_STICTION_VECTORIZED NormalLoad GapLoads::at(double approach, int contact_count, const CellForces& forces,
                                                 double mechanical_load) const {
  const int bucket_count = order_->bucketCount();
  const double width = order_->bucketWidth();
  const LargePageVector<OrderedCell>& cells = order_->cells();

  NormalLoad load;
  load.mechanical = mechanical_load;
  load.electrostatic = contact_count * forces.electrostaticInContact();

  const double cutoff_in_widths = forces.cutoff() / width;
  const int near_buckets =
      static_cast<int>(std::ceil(std::clamp(cutoff_in_widths, kFewestNearBuckets, kMostNearBuckets)));
  // a group is near as a whole: its cells are not in order
  const double past_near = std::min<double>(approach / width + 1.0 + near_buckets, bucket_count);
  int bucket = order_->groupStartFrom(static_cast<int>(past_near));
  const int near_end = order_->cellsBefore(bucket);
  forces.addCells(cells.data() + contact_count, static_cast<std::size_t>(std::max(near_end - contact_count, 0)),
                  approach, load);
  while (bucket < bucket_count) {
    const double gap_in_widths = bucket - approach / width;
    std::size_t level = bucket < order_->orderedBuckets() ? 0 : kTailLevel;
    while (level < coarser_levels_.size() && bucket % (2 << level) == 0) {
      const double wider = 2 << level;
      const bool has_kink = gap_in_widths < cutoff_in_widths && cutoff_in_widths < gap_in_widths + wider;
      if (has_kink || gap_in_widths < kGapsPerWidth * wider) break;
      ++level;
    }
    const GapMoments& gaps = momentsOf(level)[static_cast<std::size_t>(bucket >> level)];
    if (gaps.count > 0.0) {
      load.van_der_waals += forces.vanDerWaals(gaps, approach);
      load.electrostatic += forces.electrostatic(gaps, approach);
    }
    bucket += 1 << level;
  }
  return load;
}

}  // namespace mems_stiction
