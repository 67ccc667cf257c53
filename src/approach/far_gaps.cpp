#include "approach/far_gaps.hpp"

#include <cmath>
#include <limits>

#include "approach/gap_moment_sums.hpp"

namespace mems_stiction {

FarGaps::FarGaps(const HeightCounts& counts, std::int64_t bucket, double top, double range)
    : first_(top - counts.lowerEnd(bucket)), width_(counts.width()) {
  double lower_end = first_;
  GapMoments sums;
  const auto close = [&] {
    gap_sum_ += sums.count * lower_end + sums.mean;
    finishMoments(sums, lower_end);
    if (sums.count > 0.0) moments_.push_back(sums);
    sums = {};
  };
  const double variance = width_ * width_ / 12.0;  // of gaps spread over a bucket
  const std::int64_t lowest = counts.lowest();
  for (std::int64_t place = bucket - 1; place >= lowest; --place) {
    const double gap = top - counts.centre(place);
    if (gap + 0.5 * width_ - lower_end > kPart * (lower_end - first_ + range)) {
      close();
      lower_end = gap - 0.5 * width_;
    }
    const std::int64_t count = counts.countOf(place);
    counts_before_.push_back(count_);
    count_ += count;
    addGaps(sums, static_cast<double>(count), gap - lower_end);
    sums.variance += static_cast<double>(count) * variance;
  }
  close();
  counts_before_.push_back(count_);
  if (count_ == 0) first_ = std::numeric_limits<double>::infinity();
}

double FarGaps::cellsBelow(double limit) const {
  const double place = (limit - first_) / width_;
  if (count_ == 0 || !(place > 0.0)) return 0.0;
  const auto buckets = static_cast<double>(counts_before_.size() - 1);
  if (place >= buckets) return static_cast<double>(count_);
  const auto bucket = static_cast<std::size_t>(place);
  const auto before = static_cast<double>(counts_before_[bucket]);
  const auto after = static_cast<double>(counts_before_[bucket + 1]);
  return before + (place - std::floor(place)) * (after - before);
}

}  // namespace mems_stiction
