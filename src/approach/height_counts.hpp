#pragma once

/// @file
/// How many places of an area lie at which height: a histogram that holds for areas of any size,
/// because it needs neither all heights at once nor to know beforehand where they lie.
///
/// Its buckets lie at fixed heights, 2^-39 m (1.8 pm) apart, a hundredth of what forces between
/// surfaces see. Where the heights span more than 2^20 of them (1.9 um), each two neighbours become
/// one, as often as it takes. So what it counts depends on the heights alone, to the bit: not on
/// their order, nor on how they come in tiles.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mems_stiction {

/// A bucket b of width w = 2^shift 2^-39 m holds the heights that are nearest to the finest buckets
/// b 2^shift to (b + 1) 2^shift - 1.
class HeightCounts {
 public:
  /// Largest height from zero that is taken [m].
  static constexpr double kLargestHeight = 1e3;
  static constexpr std::int64_t kMostBuckets = std::int64_t{1} << 20U;

  /// Counts the heights of a row; others than finite ones are left out.
  /// - @p slots for each height: slotOf() its bucket, 0 if it was left out
  /// @throw SurfaceError if one lies beyond kLargestHeight.
  void add(const float* line, std::size_t size, std::int32_t* slots);
  void add(const double* line, std::size_t size, std::int32_t* slots);
  void add(const HeightCounts& other);

  /// Buckets that hold any height, and all between them. Not of an empty one.
  std::int64_t lowest() const;
  std::int64_t highest() const;
  bool empty() const { return total_ == 0; }
  std::int64_t total() const { return total_; }
  /// Any bucket.
  std::int64_t countOf(std::int64_t bucket) const;
  /// Heights from a bucket on upwards.
  std::int64_t countFrom(std::int64_t bucket) const;
  /// The lowest bucket that holds any height and from which on upwards there are no more than this
  /// many; one past the highest if there is none.
  std::int64_t lowestWithin(std::int64_t most_heights) const;

  double width() const;                        ///< [m]
  double lowerEnd(std::int64_t bucket) const;  ///< [m]
  double centre(std::int64_t bucket) const;    ///< [m]
  std::int64_t bucketOf(double height) const { return finestOf(height) >> shift_; }

  /// The finest bucket of a height [m], whatever the width is now.
  static std::int64_t finestOf(double height);
  /// The lowest bucket that has no height below that of a finest one.
  std::int64_t bucketAbove(std::int64_t finest) const { return -(-finest >> shift_); }
  std::int64_t finestOfBucket(std::int64_t bucket) const {
    return bucket * (std::int64_t{1} << shift_);
  }
  /// 1 and more upwards within what is counted now, until the next add().
  std::int64_t slotOf(std::int64_t bucket) const { return bucket - first_ + 1; }

  std::size_t memory() const { return counts_.capacity() * sizeof counts_[0]; }  ///< [bytes]

  /// For fromBytes(), of a machine of the same order of bytes.
  void appendTo(std::string& bytes) const;
  /// Takes itself off the front of the bytes.
  /// @throw SurfaceError if they are none.
  static HeightCounts takeFrom(std::string_view& bytes);

 private:
  template <typename Scalar>
  void addRow(const Scalar* line, std::size_t size, std::int32_t* slots);
  template <typename Scalar>
  void growToRow(const Scalar* line, std::size_t size);
  /// Makes these finest buckets part of what is counted.
  void growTo(std::int64_t lowest_finest, std::int64_t highest_finest);
  std::int64_t bucketCount() const { return static_cast<std::int64_t>(counts_.size()) - 1; }

  std::int64_t total_ = 0;
  unsigned shift_ = 0;
  std::int64_t first_ = 0;               ///< bucket of the first slot
  std::vector<std::int64_t> counts_{0};  ///< per slot; in slot 0, what was left out of the last row
};

}  // namespace mems_stiction
