#include "mems_stiction/approach/gap_order.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr int kMaxBuckets = 1 << 16;
constexpr int kMinBuckets = 1 << 6;
constexpr int kCellsPerBucket = 8;
constexpr std::ptrdiff_t kWriteAhead = 6;
/// Buckets beyond the contact limit that are ordered too: cells near the contact are summed one by one, and the wider
/// buckets of the tail start where their width is small against the gap.
constexpr int kBucketsBeyondLimit = 16 * GapOrder::kBucketsPerTailBucket;

int bucketCountFor(int valid_cells) {
  int count = kMinBuckets;
  while (count < kMaxBuckets && count * kCellsPerBucket < valid_cells) count *= 2;
  return count;
}

int roundedUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

void addGaps(GapMoments& moments, double count, double excess) {
  moments.count += count;
  moments.mean += count * excess;
  moments.variance += count * excess * excess;
}

/// Sums of gaps about the bucket's lower end become moments; no digits are lost to the size of the gap.
void finishMoments(GapMoments& moments, double lower_end) {
  if (moments.count == 0.0) return;
  const double mean_excess = moments.mean / moments.count;
  moments.variance = std::max(0.0, moments.variance / moments.count - mean_excess * mean_excess);
  moments.mean = lower_end + mean_excess;
}

template <typename Scalar>
MEMS_STICTION_INLINE void findBucketsOf(const StoredGaps<Scalar>& gaps, std::ptrdiff_t first, std::size_t size,
                                        double inverse_width, double last, std::int32_t* buckets) {
  const Scalar* relief = gaps.relief + first;
  const double top = gaps.top;
  for (std::size_t i = 0; i < size; ++i) {
    const double in_widths = (top - static_cast<double>(relief[i])) * inverse_width;
    buckets[i] = static_cast<std::int32_t>(in_widths < last ? in_widths : last);
  }
}

MEMS_STICTION_VECTORIZED void findBuckets(const StoredGaps<float>& gaps, std::ptrdiff_t first, std::size_t size,
                                          double inverse_width, double last, std::int32_t* buckets) {
  findBucketsOf(gaps, first, size, inverse_width, last, buckets);
}
MEMS_STICTION_VECTORIZED void findBuckets(const StoredGaps<double>& gaps, std::ptrdiff_t first, std::size_t size,
                                          double inverse_width, double last, std::int32_t* buckets) {
  findBucketsOf(gaps, first, size, inverse_width, last, buckets);
}

}  // namespace

void GapOrder::build(const GapField& field, double max_contact_fraction, double step, DaleMap* dales) {
  dales_ = dales;
  chooseBuckets(field, step);
  countGaps(field);
  ordered_buckets_ = 0;
  group_end_.clear();
  is_sorted_.clear();
  ordered_moments_.clear();
  orderUpTo(field, wantedCells(field, max_contact_fraction));
}

void GapOrder::extend(const GapField& field, double max_contact_fraction) {
  orderUpTo(field, wantedCells(field, max_contact_fraction));
}

int GapOrder::wantedCells(const GapField& field, double max_contact_fraction) const {
  return std::clamp(static_cast<int>(std::ceil(max_contact_fraction * field.validCount())), 1, field.validCount());
}

void GapOrder::orderUpTo(const GapField& field, int wanted) {
  const int first_bucket = ordered_buckets_;
  chooseOrderedBuckets(wanted);
  measureTail();
  collectCells(field, first_bucket);
  findContactLimit(wanted);
}

void GapOrder::chooseBuckets(const GapField& field, double step) {
  const int wanted_buckets = bucketCountFor(field.validCount());
  // a frame without relief has one bucket of any width; a denormal range would overflow the inverse
  const double range = std::max(field.largestGap(), 1e-200);
  const double steps = step > 0.0 ? std::floor(range / step) + 1.0 : kMaxBuckets + 1.0;
  groups_are_steps_ = steps <= kMaxBuckets;
  group_shift_ = 0;
  if (groups_are_steps_) {
    while (std::ldexp(steps, group_shift_ + 1) <= wanted_buckets) ++group_shift_;
    group_width_ = step;
    bucket_width_ = std::ldexp(step, -group_shift_);
    bucket_count_ = static_cast<int>(std::ldexp(steps, group_shift_));
  } else {
    group_width_ = bucket_width_ = range / wanted_buckets;
    bucket_count_ = wanted_buckets;
  }
  bucket_count_ = roundedUp(bucket_count_, std::max(kBucketsPerTailBucket, 1 << group_shift_));
  inverse_width_ = 1.0 / bucket_width_;
}

void GapOrder::countGaps(const GapField& field) {
  bucket_count_of_.assign(static_cast<std::size_t>(bucket_count_), 0);
  const auto cols = static_cast<std::size_t>(field.cols());
  row_buckets_.resize(cols);
  std::int32_t* count = bucket_count_of_.data();
  field.readGaps([&](const auto& gaps) {
    for (int row = 0; row < field.rows(); ++row) {
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(row) * field.cols();
      findBuckets(gaps, first, cols, inverse_width_, bucket_count_ - 1, row_buckets_.data());
      for (const std::int32_t bucket : row_buckets_) ++count[bucket];
    }
  });
  bucket_count_of_.back() -= field.cellCount() - field.validCount();  // infinite gaps were counted there
}

void GapOrder::chooseOrderedBuckets(int wanted) {
  int total = 0;
  int bucket = 0;
  while (total < wanted) total += bucket_count_of_[static_cast<std::size_t>(bucket++)];
  const int wanted_buckets = std::min(
      roundedUp(bucket + kBucketsBeyondLimit, std::max(kBucketsPerTailBucket, 1 << group_shift_)), bucket_count_);
  ordered_buckets_ = std::max(ordered_buckets_, wanted_buckets);
}

void GapOrder::measureTail() {
  tail_moments_.assign(static_cast<std::size_t>((bucket_count_ - ordered_buckets_) / kBucketsPerTailBucket), {});
  int bucket = ordered_buckets_;
  for (GapMoments& moments : tail_moments_) {
    const double lower_end = bucket * bucket_width_;
    for (int i = 0; i < kBucketsPerTailBucket; ++i, ++bucket) {
      addGaps(moments, bucket_count_of_[static_cast<std::size_t>(bucket)], (i + 0.5) * bucket_width_);
    }
    finishMoments(moments, lower_end);
  }
}

int GapOrder::openGroups(int first_bucket, int end_bucket) {
  int start = groupStart(first_bucket >> group_shift_);
  for (int bucket = first_bucket; bucket < end_bucket; ++bucket) {
    const auto group = static_cast<std::size_t>(bucket >> group_shift_);
    if (bucket >> group_shift_ << group_shift_ == bucket) {
      group_end_[group] = start;  // becomes the group's end while it is filled
      is_sorted_[group] = 0;
    }
    start += bucket_count_of_[static_cast<std::size_t>(bucket)];
    ordered_moments_[static_cast<std::size_t>(bucket)] = {};
  }
  return start;
}

MEMS_STICTION_INLINE void GapOrder::put(const OrderedCell& cell, int bucket) {
  OrderedCell& place = cells_[static_cast<std::size_t>(group_end_[static_cast<std::size_t>(bucket >> group_shift_)]++)];
  place = cell;
  __builtin_prefetch(&place + kWriteAhead, 1);  // where the group goes on: there are too many for the processor
}

void GapOrder::closeGroups(int first_bucket, int end_bucket) {
  // group by group: while the cells come in, the moments of another bucket would be fetched for each
  for (int group = first_bucket >> group_shift_; group < end_bucket >> group_shift_; ++group) {
    if (group_shift_ == 0) {
      measureBucket(group);
    } else {
      for (int place = groupStart(group); place < groupStart(group + 1); ++place) {
        const double gap = cells_[static_cast<std::size_t>(place)].gap;
        const int bucket = bucketOf(gap);
        addGaps(ordered_moments_[static_cast<std::size_t>(bucket)], 1.0, gap - bucket * bucket_width_);
      }
    }
  }
  for (int bucket = first_bucket; bucket < end_bucket; ++bucket) {
    finishMoments(ordered_moments_[static_cast<std::size_t>(bucket)], bucket * bucket_width_);
  }
}

void GapOrder::measureBucket(int bucket) {
  const double lower_end = bucket * bucket_width_;
  GapMoments moments;
  for (int place = groupStart(bucket); place < groupStart(bucket + 1); ++place) {
    addGaps(moments, 1.0, cells_[static_cast<std::size_t>(place)].gap - lower_end);
  }
  ordered_moments_[static_cast<std::size_t>(bucket)] = moments;
}

MEMS_STICTION_VECTORIZED void GapOrder::changeGaps(double limit, const std::vector<double>& gaps) {
  const int end_bucket = (std::min(bucketOf(limit) >> group_shift_, groupCount() - 1) + 1) << group_shift_;
  changed_cells_.assign(cells_.begin(), cells_.begin() + cellsBefore(end_bucket));
  std::fill_n(bucket_count_of_.begin(), end_bucket, 0);
  for (std::size_t i = 0; i < changed_cells_.size(); ++i) {
    if (i < gaps.size()) changed_cells_[i].gap = gaps[i];
    ++bucket_count_of_[static_cast<std::size_t>(bucketOf(changed_cells_[i].gap))];
  }
  openGroups(0, end_bucket);
  for (const OrderedCell& cell : changed_cells_) put(cell, bucketOf(cell.gap));
  closeGroups(0, end_bucket);
}

void GapOrder::collectCells(const GapField& field, int first_bucket) {
  group_end_.resize(static_cast<std::size_t>(ordered_buckets_ >> group_shift_), 0);
  is_sorted_.resize(group_end_.size(), 0);
  ordered_moments_.resize(static_cast<std::size_t>(ordered_buckets_), {});
  cells_.resize(static_cast<std::size_t>(openGroups(first_bucket, ordered_buckets_)));
  const bool all_are_ordered = ordered_buckets_ == bucket_count_;
  const double from = first_bucket > 0 ? (first_bucket - 1) * bucket_width_ : 0.0;
  const double limit = all_are_ordered ? GapField::kInvalidGap : (ordered_buckets_ + 1) * bucket_width_;
  row_gaps_.resize(static_cast<std::size_t>(field.cols()));
  near_cells_.resize(static_cast<std::size_t>(field.cols()));
  row_tags_.assign(static_cast<std::size_t>(field.cols()), {});
  bool any_is_misplaced = false;
  if (dales_ != nullptr) {
    dale_rows_.start(field, *dales_, from, limit);
    while (dale_rows_.next()) {
      const RowsAround& rows = dale_rows_.around();
      const std::int32_t* columns = dale_rows_.columns();
      rows.tagsOf(columns, dale_rows_.count(), row_tags_.data());
      any_is_misplaced |=
          collectRow(dale_rows_.row(), rows.gaps, columns, dale_rows_.count(), row_tags_.data(), first_bucket);
    }
  } else {
    for (int row = 0; row < field.rows(); ++row) {
      field.gapsOfRow(row, row_gaps_.data());
      const int count = columnsBetween(from, limit, row_gaps_.data(), field.cols(), near_cells_.data());
      any_is_misplaced |= collectRow(row, row_gaps_.data(), near_cells_.data(), count, row_tags_.data(), first_bucket);
    }
  }
  closeGroups(first_bucket, ordered_buckets_);
  if (any_is_misplaced) mendGroups();
}

MEMS_STICTION_VECTORIZED bool GapOrder::collectRow(int row, const double* gaps, const std::int32_t* columns, int count,
                                                   const DaleTag* tags, int first_bucket) {
  bool any_is_misplaced = false;
  const std::int32_t first_cell = row * static_cast<std::int32_t>(row_gaps_.size());
  const auto buckets = static_cast<std::uint32_t>(ordered_buckets_ - first_bucket);
  for (int i = 0; i < count; ++i) {
    const std::int32_t col = columns[i];
    const double gap = gaps[col];
    const int bucket = bucketOf(gap);
    if (static_cast<std::uint32_t>(bucket - first_bucket) >= buckets) continue;
    put({gap, first_cell + col, tags[i]}, bucket);
    const double excess = gap - bucket * bucket_width_;
    if (isNearBorder(excess) && mendedGroup(gap, bucket) != bucket >> group_shift_) any_is_misplaced = true;
  }
  return any_is_misplaced;
}

int GapOrder::mendedGroup(double gap, int bucket) const {
  const int group = bucket >> group_shift_;
  if (!groups_are_steps_) return group;
  if (gap < groupLowerEnd(group)) return group - 1;
  return gap >= groupLowerEnd(group + 1) ? std::min(group + 1, groupCount() - 1) : group;
}

void GapOrder::mendGroups() {
  double largest_before = -1.0;
  int place = 0;
  for (int group = 0; group < groupCount(); ++group) {
    double smallest = GapField::kInvalidGap;
    double largest = largest_before;
    for (; place < group_end_[static_cast<std::size_t>(group)]; ++place) {
      const double gap = cells_[static_cast<std::size_t>(place)].gap;
      smallest = std::min(smallest, gap);
      largest = std::max(largest, gap);
    }
    const double boundary = group * group_width_;
    if (group > 0 && (largest_before >= boundary || smallest < boundary)) mendBoundary(group);
    largest_before = largest;
  }
}

/// The bucket of a gap that is a whole number of steps is a matter of rounding; a step takes what is below its
/// approach.
void GapOrder::mendBoundary(int group) {
  const double boundary = group * group_width_;
  const auto begin = cells_.begin() + groupStart(group - 1);
  const auto end = cells_.begin() + group_end_[static_cast<std::size_t>(group)];
  const auto first_apart =
      std::stable_partition(begin, end, [boundary](const OrderedCell& cell) { return cell.gap < boundary; });
  group_end_[static_cast<std::size_t>(group - 1)] = static_cast<std::int32_t>(first_apart - cells_.begin());
}

void GapOrder::sortGroup(int group) {
  std::uint8_t& is_sorted = is_sorted_[static_cast<std::size_t>(group)];
  if (is_sorted != 0) return;
  std::sort(cells_.begin() + groupStart(group), cells_.begin() + group_end_[static_cast<std::size_t>(group)],
            [](const OrderedCell& a, const OrderedCell& b) { return comesBefore(a.gap, a.cell, b.gap, b.cell); });
  is_sorted = 1;
}

void GapOrder::findContactLimit(int wanted) {
  const int limit_group = groupOfPlace(wanted - 1);
  sortGroup(limit_group);
  contact_limit_ = wanted;
  const double limit_gap = cells_[static_cast<std::size_t>(wanted - 1)].gap;
  while (contact_limit_ < group_end_[static_cast<std::size_t>(limit_group)] &&
         cells_[static_cast<std::size_t>(contact_limit_)].gap == limit_gap) {
    ++contact_limit_;
  }
}

int GapOrder::groupOfPlace(int place) const {
  const auto end = std::upper_bound(group_end_.begin(), group_end_.end(), place);
  return static_cast<int>(end - group_end_.begin());
}

int GapOrder::sortBelow(double approach) {
  const int group_count = groupCount();
  if (approach >= group_count * group_width_ && ordered_buckets_ < bucket_count_) {
    return static_cast<int>(cells_.size());
  }
  const double group_of_approach = std::min<double>(std::round(approach / group_width_), group_count);
  if (groups_are_steps_ && group_of_approach * group_width_ == approach) {
    return groupStart(static_cast<int>(group_of_approach));
  }
  const int group = std::min(bucketOf(approach) >> group_shift_, group_count - 1);
  sortGroup(group);
  const auto begin = cells_.begin() + groupStart(group);
  const auto first_apart = std::partition_point(begin, cells_.begin() + group_end_[static_cast<std::size_t>(group)],
                                                [approach](const OrderedCell& cell) { return cell.gap < approach; });
  return static_cast<int>(first_apart - cells_.begin());
}

double GapOrder::cellsBelow(double limit) const {
  const double limit_in_widths = limit * inverse_width_;
  if (limit_in_widths < ordered_buckets_) {
    const int group = static_cast<int>(std::max(limit_in_widths, 0.0)) >> group_shift_;
    const auto begin = cells_.begin() + groupStart(group);
    const auto end = cells_.begin() + group_end_[static_cast<std::size_t>(group)];
    return static_cast<double>(
        groupStart(group) + std::count_if(begin, end, [limit](const OrderedCell& cell) { return cell.gap < limit; }));
  }
  auto count = static_cast<double>(cells_.size());
  for (int bucket = ordered_buckets_; bucket < bucket_count_ && bucket < limit_in_widths; ++bucket) {
    // the largest gap is the last bucket's upper end, and below any limit past it
    const double covered = std::min(limit_in_widths - bucket, 1.0);
    count += covered * bucket_count_of_[static_cast<std::size_t>(bucket)];
  }
  return count;
}

double GapOrder::lowerEndAt(int place) const {
  int before = 0;
  int bucket = 0;
  while (bucket + 1 < bucket_count_ && before + bucket_count_of_[static_cast<std::size_t>(bucket)] <= place) {
    before += bucket_count_of_[static_cast<std::size_t>(bucket++)];
  }
  return bucket * bucket_width_;
}

void GapOrder::sortBetween(int begin, int end) {
  for (int group = groupOfPlace(begin); group < groupCount(); ++group) {
    if (groupStart(group) >= end) break;
    sortGroup(group);
  }
}

int GapOrder::groupStartFrom(int bucket) const {
  return std::min(roundedUp(bucket, 1 << group_shift_), ordered_buckets_);
}

int GapOrder::cellsBefore(int group_start_bucket) const { return groupStart(group_start_bucket >> group_shift_); }

}  // namespace mems_stiction
