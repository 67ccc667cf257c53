#include "approach/gap_pyramid.hpp"

namespace mems_stiction {
namespace {

GapMoments merged(const GapMoments& a, const GapMoments& b) {
  if (a.count == 0.0) return b;
  if (b.count == 0.0) return a;
  GapMoments sum;
  sum.count = a.count + b.count;
  sum.mean = (a.count * a.mean + b.count * b.mean) / sum.count;
  const double distance = b.mean - a.mean;
  sum.variance = (a.count * a.variance + b.count * b.variance +
                  a.count * b.count / sum.count * distance * distance) /
                 sum.count;
  return sum;
}

}  // namespace

void GapPyramid::prepare(const GapOrder& order) {
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

}  // namespace mems_stiction
