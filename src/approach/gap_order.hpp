#pragma once

/// @file
/// Cells in order of gap: the order in which they come into contact as the upper surface is brought
/// down.
///
/// The cells that can come into contact are put into groups, lowest gaps first; a group is what one
/// step of the approach adds. Inside a group they stay in the order of the frame, so that the sweep
/// walks through memory, and are sorted only when somebody asks for a place inside. A finer
/// histogram keeps count, mean and variance of the gaps, from which the load sums of all steps are
/// made; cells that stay apart are only counted.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "approach/dale_map.hpp"
#include "approach/dale_rows.hpp"
#include "approach/gap_field.hpp"
#include "numeric/large_pages.hpp"

namespace mems_stiction {

/// A cell and its gap.
struct OrderedCell {
  double gap;  ///< [m]
  std::int32_t cell;
  DaleTag tag;  ///< if the order was built with dales
};

/// Gaps of one bucket, or of several neighbouring ones.
struct GapMoments {
  double count = 0.0;
  double mean = 0.0;      ///< [m]
  double variance = 0.0;  ///< [m^2]
};

/// The cells of a field in order of gap, sorted as far as the approach has come.
class GapOrder {
 public:
  /// - @p max_contact_fraction contact is searched up to this share of the valid cells, in (0, 1].
  /// - @p step delta of the approach [m]: sortBelow() its multiples costs nothing. 0, or a step
  /// that is tiny against
  ///   the range of the gap, gives groups of one bucket.
  /// - @p dales of the field, if the cells shall bear theirs: nullptr or outlives the order's use.
  void build(const GapField& field, double max_contact_fraction, double step = 0.0,
             DaleMap* dales = nullptr);
  /// The same order up to a larger share of the valid cells; those that are in order stay there.
  /// - @p field, and max_contact_fraction, as in build(), with a step of 0
  void extend(const GapField& field, double max_contact_fraction);
  /// The cells with a gap below `limit` [m], in the order in which they stand, get other ones.
  /// - @p gaps one for each of them [m], in [0, limit); with a step of 0
  void changeGaps(double limit, const std::vector<double>& gaps);

  /// In order of group; at least contactLimit() of them, and some more beyond. Cells of equal gaps
  /// stand in the order of the frame.
  const LargePageVector<OrderedCell>& cells() const { return cells_; }
  /// Number of cells in contact at the first gap level that reaches the contact fraction limit. The
  /// cells up to there are those of the smallest gaps, and the last one has that gap.
  int contactLimit() const { return contact_limit_; }
  /// Brings the ordered cells with gap < approach to the front, all before the others.
  /// @return their number
  int sortBelow(double approach);
  /// Number of valid cells with gap < limit, wherever the limit lies: exact where the cells are
  /// ordered, from the counts of the buckets beyond.
  double cellsBelow(double limit) const;
  /// Lower end of the bucket that contains the gap of this place, ordered or not [m].
  double lowerEndAt(int place) const;
  /// Sorts the groups that reach into these places, by gap, then by cell.
  void sortBetween(int begin, int end);

  /// Buckets 0 .. bucketCount()-1 cover the range of the gap; each is bucketWidth() wide [m].
  int bucketCount() const { return bucket_count_; }
  double bucketWidth() const { return bucket_width_; }
  /// Number of leading buckets whose cells are in cells(); a multiple of kBucketsPerTailBucket.
  int orderedBuckets() const { return ordered_buckets_; }
  /// Gaps of each ordered bucket.
  const std::vector<GapMoments>& orderedMoments() const { return ordered_moments_; }
  /// Gaps of the buckets beyond, kBucketsPerTailBucket of them together, each cell at the middle of
  /// its bucket: they are far from contact against the width of a bucket.
  const std::vector<GapMoments>& tailMoments() const { return tail_moments_; }

  /// The first ordered bucket that starts a group at or beyond `bucket`, or orderedBuckets().
  int groupStartFrom(int bucket) const;
  /// Index of the first ordered cell at or past a bucket that starts a group.
  int cellsBefore(int group_start_bucket) const;

  int groupCount() const { return static_cast<int>(group_end_.size()); }
  /// Index of the first ordered cell of a group; of the group past the last one: the number of
  /// ordered cells.
  int groupStart(int group) const {
    return group == 0 ? 0 : group_end_[static_cast<std::size_t>(group - 1)];
  }
  /// The group that contains this place of the order.
  int groupOfPlace(int place) const;
  /// Where a group starts, give or take one bucketWidth() [m].
  double groupLowerEnd(int group) const { return group * group_width_; }
  /// The group of a cell with this gap, exactly; groupCount() if the cell is not ordered.
  int groupOf(double gap) const {
    const int bucket = bucketOf(gap);
    if (bucket >= ordered_buckets_) return groupCount();
    return isNearBorder(gap - bucket * bucket_width_) ? mendedGroup(gap, bucket)
                                                      : bucket >> group_shift_;
  }

  static constexpr int kBucketsPerTailBucket = 16;

 private:
  void chooseBuckets(const GapField& field, double step);
  void countGaps(const GapField& field);
  void chooseOrderedBuckets(int wanted);
  void measureTail();
  int wantedCells(const GapField& field, double max_contact_fraction) const;
  void orderUpTo(const GapField& field, int wanted);
  /// Makes room for the cells of these buckets; each group's end is its start until they are put
  /// there.
  /// @return the place behind them
  int openGroups(int first_bucket, int end_bucket);
  void put(const OrderedCell& cell, int bucket);
  /// Takes the moments of buckets whose cells are all there.
  void closeGroups(int first_bucket, int end_bucket);
  /// The sums of one that is a group.
  void measureBucket(int bucket);
  /// From this bucket to the last ordered one.
  void collectCells(const GapField& field, int first_bucket);
  /// Puts the cells of a row into their groups.
  /// - @p gaps of the row's cells [m]
  /// - @p columns of those that may belong there, @p tags theirs
  /// @return whether rounding may have put one of them into the wrong group
  bool collectRow(int row, const double* gaps, const std::int32_t* columns, int count,
                  const DaleTag* tags, int first_bucket);
  /// Whether rounding may have decided on the bucket of a gap that lies so far beyond the bucket's
  /// lower end [m]: the margin is wider than the rounding of this difference too.
  bool isNearBorder(double excess) const {
    constexpr double kMargin = 1e-9;  // of a width; 2^16 buckets round to 1e-11 of one
    return excess < kMargin * bucket_width_ || excess >= (1.0 - kMargin) * bucket_width_;
  }
  /// The bucket of a gap that is a whole number of steps is a matter of rounding, its group is not.
  int mendedGroup(double gap, int bucket) const;
  void mendGroups();
  /// The last bucket contains what rounding puts beyond it.
  int bucketOf(double gap) const {
    return static_cast<int>(std::min(gap * inverse_width_, bucket_count_ - 1.0));
  }
  void mendBoundary(int group);
  void sortGroup(int group);
  void findContactLimit(int wanted);

  int bucket_count_ = 0;
  double bucket_width_ = 1.0;
  double inverse_width_ = 1.0;
  int group_shift_ = 0;  ///< a group is 2^group_shift_ buckets
  double group_width_ = 1.0;
  bool groups_are_steps_ = false;
  int ordered_buckets_ = 0;
  int contact_limit_ = 0;
  std::vector<std::int32_t> bucket_count_of_;
  std::vector<std::int32_t> group_end_;
  std::vector<std::uint8_t> is_sorted_;
  std::vector<double> row_gaps_;
  std::vector<std::int32_t> row_buckets_;
  std::vector<std::int32_t> near_cells_;
  std::vector<DaleTag> row_tags_;
  LargePageVector<OrderedCell> changed_cells_;
  DaleMap* dales_ = nullptr;
  DaleRows dale_rows_;
  LargePageVector<OrderedCell> cells_;
  std::vector<GapMoments> ordered_moments_;
  std::vector<GapMoments> tail_moments_;
};

}  // namespace mems_stiction
