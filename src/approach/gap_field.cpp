#include "approach/gap_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

/// Largest range of the relief [m]: squares of gaps, summed over any frame, stay finite.
constexpr double kLargestRange = 1e100;

std::string gridText(const HeightMap& surface) {
  return std::to_string(surface.rows()) + " rows x " + std::to_string(surface.cols()) +
         " columns, pitch " + numberText(surface.pitchX()) + " x " + numberText(surface.pitchY()) +
         " m";
}

void requireSameGrid(const HeightMap& lower, const HeightMap& upper) {
  constexpr double kPitchTolerance =
      1e-6;  // relative; pitches come through float32 files and decimal text
  const bool same_size = lower.rows() == upper.rows() && lower.cols() == upper.cols();
  const bool same_pitch =
      std::abs(lower.pitchX() - upper.pitchX()) <= kPitchTolerance * lower.pitchX() &&
      std::abs(lower.pitchY() - upper.pitchY()) <= kPitchTolerance * lower.pitchY();
  if (same_size && same_pitch) return;
  throw SurfaceError("the counter-surface's grid (" + gridText(upper) + ") must be the scan's (" +
                     gridText(lower) + ")");
}

/// Sums over valid heights, in fixed packets. They are taken from a level that is one of the
/// heights: it can stand for what is left out, and adds nothing.
struct HeightSums {
  explicit HeightSums(double level_in) : level(level_in), highest(level_in), lowest(level_in) {}

  MEMS_STICTION_INLINE void add(const Packet& heights) {
    const PacketMask is_valid = heights - heights == 0.0;
    const Packet valid = select(is_valid, heights, level);
    const Packet excess = valid - level;
    counts += select(is_valid, Packet(1.0), 0.0);
    sum += excess;
    squares += excess * excess;
    highest = select(valid > highest, valid, highest);
    lowest = select(valid < lowest, valid, lowest);
  }

  std::size_t count() const { return static_cast<std::size_t>(counts.sum()); }

  double level;  ///< [m]
  Packet counts = 0.0;
  Packet sum = 0.0;
  Packet squares = 0.0;
  Packet highest;
  Packet lowest;
};

template <typename Scalar>
MEMS_STICTION_INLINE void addHeights(const Scalar* line, std::size_t size, HeightSums& sums) {
  constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();
  HeightSums local = sums;
  const std::size_t in_packets = size / Packet::kCount * Packet::kCount;
  for (std::size_t i = 0; i < in_packets; i += Packet::kCount) local.add(Packet::load(line + i));
  if (in_packets < size)
    local.add(Packet::loadFirst(line + in_packets, size - in_packets, kNoHeight));
  sums = local;
}

MEMS_STICTION_VECTORIZED void addRow(const float* line, std::size_t size, HeightSums& sums) {
  addHeights(line, size, sums);
}
MEMS_STICTION_VECTORIZED void addRow(const double* line, std::size_t size, HeightSums& sums) {
  addHeights(line, size, sums);
}

template <typename Scalar>
MEMS_STICTION_INLINE void gapsBelowTop(double top, const Scalar* relief, std::size_t size,
                                       double* gaps) {
  for (std::size_t i = 0; i < size; ++i) gaps[i] = top - static_cast<double>(relief[i]);
}

MEMS_STICTION_VECTORIZED void gapsBelow(double top, const float* relief, std::size_t size,
                                        double* gaps) {
  gapsBelowTop(top, relief, size, gaps);
}
MEMS_STICTION_VECTORIZED void gapsBelow(double top, const double* relief, std::size_t size,
                                        double* gaps) {
  gapsBelowTop(top, relief, size, gaps);
}

}  // namespace

template <typename Grid>
void GapField::takeGrid(const Grid& grid) {
  rows_ = grid.rows();
  cols_ = grid.cols();
  pitch_x_ = grid.pitchX();
  pitch_y_ = grid.pitchY();
}

template <typename Scalar, typename RowSource>
void GapField::fillRelief(LargePageVector<Scalar>& relief, const RowSource& fill_row) {
  is_single_ = std::is_same<Scalar, float>::value;
  const auto cols = static_cast<std::size_t>(cols_);
  relief.resize(static_cast<std::size_t>(cellCount()));
  HeightSums sums(std::numeric_limits<double>::quiet_NaN());
  const auto isFinite = [](Scalar height) { return std::isfinite(height); };
  Scalar* line = relief.data();
  for (int row = 0; row < rows_; ++row, line += cols) {
    fill_row(row, line);
    const std::size_t count_before = sums.count();
    if (count_before == 0) {  // the level is the first valid height
      const Scalar* valid = std::find_if(line, line + cols, isFinite);
      if (valid != line + cols) sums = HeightSums(*valid);
    }
    addRow(line, cols, sums);
    if (sums.count() - count_before == cols) continue;
    std::replace_if(
        line, line + cols, [&](Scalar height) { return !isFinite(height); },
        -std::numeric_limits<Scalar>::infinity());
  }
  if (sums.count() == 0) {
    throw SurfaceError(upper_is_flat_
                           ? "the height map has no valid pixel"
                           : "no pixel is valid in both the scan and the counter-surface");
  }
  const auto count = static_cast<double>(sums.count());
  valid_count_ = static_cast<int>(sums.count());
  top_ = sums.highest.largest();
  largest_gap_ = top_ - sums.lowest.smallest();
  if (!(largest_gap_ <= kLargestRange)) {
    throw SurfaceError(
        std::string(upper_is_flat_ ? "the heights lie" : "scan minus counter-surface lies") +
        " between " + numberText(sums.lowest.smallest()) + " and " + numberText(top_) +
        " m, which is not allowed: the range must be <= " + numberText(kLargestRange) + " m");
  }
  const double mean_excess = sums.sum.sum() / count;
  mean_gap_ = (top_ - sums.level) - mean_excess;
  rms_gap_ = std::sqrt(std::max(0.0, sums.squares.sum() / count - mean_excess * mean_excess));
}

void GapField::compute(const SurfacePair& surfaces) {
  if (!surfaces.upperIsPlane()) requireSameGrid(surfaces.lower, surfaces.upper);
  takeGrid(surfaces.lower);
  upper_is_flat_ = surfaces.upperIsPlane();
  if (upper_is_flat_) {
    computeAgainstPlane(surfaces.lower);
  } else {
    computeBetween(surfaces.lower, surfaces.upper);
  }
}

void GapField::lower(const GapField& field, const cv::Mat1d& lowering) {
  takeGrid(field);
  upper_is_flat_ = false;
  lower_.resize(static_cast<std::size_t>(cellCount()));
  fillRelief(relief_, [&](int row, double* line) {
    field.gapsOfRow(row, line);
    const double* const down = lowering[row];
    double* const lower_line = lower_.data() + static_cast<std::ptrdiff_t>(row) * cols_;
    for (int col = 0; col < cols_; ++col) {
      line[col] = -line[col] - down[col];
      lower_line[col] = std::isfinite(line[col]) ? field.lowerHeight(row * cols_ + col) : 0.0;
    }
  });
}

void GapField::lower(const GapField& field, const PressedCells& cells,
                     const std::vector<double>& lowering) {
  takeGrid(field);
  upper_is_flat_ = field.upper_is_flat_;
  if (!upper_is_flat_) lower_ = field.lower_;
  fillRelief(relief_, [&](int row, double* line) {
    field.gapsOfRow(row, line);
    for (int col = 0; col < cols_; ++col) line[col] = -line[col];
    const auto place = static_cast<std::size_t>(row);
    for (int i = cells.row_begin[place]; i < cells.row_begin[place + 1]; ++i) {
      const auto cell = static_cast<std::size_t>(i);
      line[cells.columns[cell]] -= lowering[cell];
    }
  });
}

void GapField::computeAgainstPlane(const HeightMap& lower) {
  const auto copyInto = [&](auto& relief) {
    fillRelief(relief, [&](int row, auto* line) {
      using Scalar = std::remove_reference_t<decltype(*line)>;
      std::copy_n(lower.heights().ptr<Scalar>(row), cols_, line);
    });
  };
  if (lower.heights().depth() == CV_32F) {
    copyInto(single_relief_);
  } else {
    copyInto(relief_);
  }
}

void GapField::gapsOfRow(int row, double* gaps) const {
  const auto cols = static_cast<std::size_t>(cols_);
  const std::size_t first = static_cast<std::size_t>(row) * cols;
  if (is_single_) {
    gapsBelow(top_, single_relief_.data() + first, cols, gaps);
  } else {
    gapsBelow(top_, relief_.data() + first, cols, gaps);
  }
}

template <typename LowerScalar, typename UpperScalar>
void GapField::subtractSurfaces(const HeightMap& lower, const HeightMap& upper) {
  double level = std::numeric_limits<double>::quiet_NaN();
  fillRelief(relief_, [&](int row, double* line) {
    const LowerScalar* line1 = lower.heights().ptr<LowerScalar>(row);
    const UpperScalar* line2 = upper.heights().ptr<UpperScalar>(row);
    double* lower_line = lower_.data() + static_cast<std::ptrdiff_t>(row) * cols_;
    for (int col = 0; col < cols_; ++col) {
      const double height = line1[col];
      line[col] = height - line2[col];
      const bool is_valid = std::isfinite(line[col]);
      if (is_valid && std::isnan(level)) level = height;
      lower_line[col] = is_valid ? height - level : 0.0;
    }
  });
}

void GapField::computeBetween(const HeightMap& lower, const HeightMap& upper) {
  lower_.resize(static_cast<std::size_t>(cellCount()));
  const bool lower_is_single = lower.heights().depth() == CV_32F;
  const bool upper_is_single = upper.heights().depth() == CV_32F;
  if (lower_is_single) {
    upper_is_single ? subtractSurfaces<float, float>(lower, upper)
                    : subtractSurfaces<float, double>(lower, upper);
  } else {
    upper_is_single ? subtractSurfaces<double, float>(lower, upper)
                    : subtractSurfaces<double, double>(lower, upper);
  }
}

MEMS_STICTION_VECTORIZED int columnsBetween(double from, double limit, const double* gaps, int cols,
                                            std::int32_t* columns) {
  // Surfaces are smooth on the scale of a few cells: blocks that are wholly inside or outside are
  // frequent.
  constexpr std::int32_t kBlock = 8;
  std::int32_t* next = columns;
  std::int32_t col = 0;
  for (; col + kBlock <= cols; col += kBlock, gaps += kBlock) {
    const Packet first = Packet::load(gaps);
    const Packet second = Packet::load(gaps + Packet::kCount);
    const int count =
        ((first < limit) ^ (first < from)).count() + ((second < limit) ^ (second < from)).count();
    if (count == 0) continue;
    if (count == kBlock) {
      for (std::int32_t i = 0; i < kBlock; ++i) next[i] = col + i;
      next += kBlock;
      continue;
    }
    for (std::int32_t i = 0; i < kBlock; ++i) {  // which ones is random: written without a branch
      *next = col + i;
      next += static_cast<int>(gaps[i] < limit) & static_cast<int>(gaps[i] >= from);
    }
  }
  for (; col < cols; ++col, ++gaps) {
    *next = col;
    next += *gaps < limit && *gaps >= from ? 1 : 0;
  }
  return static_cast<int>(next - columns);
}

void GapField::prefetchLower(int cell) const {
  if (upper_is_flat_) return;
  const double* const heights = lower_.data();
  __builtin_prefetch(heights + cell);
  __builtin_prefetch(heights + std::max(cell - cols_, 0));
  __builtin_prefetch(heights + std::min(cell + cols_, cellCount() - 1));
}

}  // namespace mems_stiction
