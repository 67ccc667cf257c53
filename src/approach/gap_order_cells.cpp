/// The part of GapOrder that puts cells into their groups.

#include <algorithm>

#include "approach/gap_moment_sums.hpp"
#include "approach/gap_order.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr std::ptrdiff_t kWriteAhead = 6;

}  // namespace

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
  OrderedCell& place = cells_[static_cast<std::size_t>(
      group_end_[static_cast<std::size_t>(bucket >> group_shift_)]++)];
  place = cell;
  __builtin_prefetch(&place + kWriteAhead,
                     1);  // where the group goes on: there are too many for the processor
}

void GapOrder::closeGroups(int first_bucket, int end_bucket) {
  // group by group: while the cells come in, the moments of another bucket would be fetched for
  // each
  for (int group = first_bucket >> group_shift_; group < end_bucket >> group_shift_; ++group) {
    if (group_shift_ == 0) {
      measureBucket(group);
    } else {
      for (int place = groupStart(group); place < groupStart(group + 1); ++place) {
        const double gap = cells_[static_cast<std::size_t>(place)].gap;
        const int bucket = bucketOf(gap);
        addGaps(ordered_moments_[static_cast<std::size_t>(bucket)], 1.0,
                gap - bucket * bucket_width_);
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
  const int end_bucket = (std::min(bucketOf(limit) >> group_shift_, groupCount() - 1) + 1)
                         << group_shift_;
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
  const double limit =
      all_are_ordered ? GapField::kInvalidGap : (ordered_buckets_ + 1) * bucket_width_;
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
      any_is_misplaced |= collectRow(dale_rows_.row(), rows.gaps, columns, dale_rows_.count(),
                                     row_tags_.data(), first_bucket);
    }
  } else {
    for (int row = 0; row < field.rows(); ++row) {
      field.gapsOfRow(row, row_gaps_.data());
      const int count =
          columnsBetween(from, limit, row_gaps_.data(), field.cols(), near_cells_.data());
      any_is_misplaced |= collectRow(row, row_gaps_.data(), near_cells_.data(), count,
                                     row_tags_.data(), first_bucket);
    }
  }
  closeGroups(first_bucket, ordered_buckets_);
  if (any_is_misplaced) mendGroups();
}

MEMS_STICTION_VECTORIZED bool GapOrder::collectRow(int row, const double* gaps,
                                                   const std::int32_t* columns, int count,
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
    if (isNearBorder(excess) && mendedGroup(gap, bucket) != bucket >> group_shift_)
      any_is_misplaced = true;
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

/// The bucket of a gap that is a whole number of steps is a matter of rounding; a step takes what
/// is below its approach.
void GapOrder::mendBoundary(int group) {
  const double boundary = group * group_width_;
  const auto begin = cells_.begin() + groupStart(group - 1);
  const auto end = cells_.begin() + group_end_[static_cast<std::size_t>(group)];
  const auto first_apart = std::stable_partition(
      begin, end, [boundary](const OrderedCell& cell) { return cell.gap < boundary; });
  group_end_[static_cast<std::size_t>(group - 1)] =
      static_cast<std::int32_t>(first_apart - cells_.begin());
}

}  // namespace mems_stiction
