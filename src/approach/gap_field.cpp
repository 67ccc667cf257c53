#include "mems_stiction/approach/gap_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/lanes.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {
namespace {

std::string gridText(const HeightMap& surface) {
  return std::to_string(surface.rows()) + " rows x " + std::to_string(surface.cols()) + " columns, pitch " +
         numberText(surface.pitchX()) + " x " + numberText(surface.pitchY()) + " m";
}

void requireSameGrid(const HeightMap& lower, const HeightMap& upper) {
  constexpr double kPitchTolerance = 1e-6;  // relative; pitches come through float32 files and decimal text
  const bool same_size = lower.rows() == upper.rows() && lower.cols() == upper.cols();
  const bool same_pitch = std::abs(lower.pitchX() - upper.pitchX()) <= kPitchTolerance * lower.pitchX() &&
                          std::abs(lower.pitchY() - upper.pitchY()) <= kPitchTolerance * lower.pitchY();
  if (same_size && same_pitch) return;
  throw SurfaceError("the counter-surface's grid (" + gridText(upper) + ") must be the scan's (" + gridText(lower) +
                     ")");
}

/// Highest valid height of a line.
template <typename Scalar>
inline Scalar highestOfLanes(const Scalar* line, std::size_t size) {
  constexpr Scalar kLargest = std::numeric_limits<Scalar>::max();
  constexpr std::size_t kMaxima = 8;  // independent ones, which the compiler turns into vector instructions
  Scalar highest[kMaxima];
  std::fill(highest, highest + kMaxima, -kLargest);
  std::size_t i = 0;
  for (; i + kMaxima <= size; i += kMaxima) {
    for (std::size_t lane = 0; lane < kMaxima; ++lane) {
      const Scalar height = line[i + lane];
      const bool is_higher = height > highest[lane] && height <= kLargest;  // false for NaN and infinity
      highest[lane] = is_higher ? height : highest[lane];
    }
  }
  for (; i < size; ++i) {
    if (line[i] > highest[0] && line[i] <= kLargest) highest[0] = line[i];
  }
  return *std::max_element(highest, highest + kMaxima);
}

MEMS_STICTION_VECTORIZED float highestOf(const float* line, std::size_t size) { return highestOfLanes(line, size); }
MEMS_STICTION_VECTORIZED double highestOf(const double* line, std::size_t size) { return highestOfLanes(line, size); }

template <typename Scalar>
inline void gapsBelowLine(double top, const Scalar* line, std::size_t size, double* gap) {
  for (std::size_t i = 0; i < size; ++i) {
    const double height = line[i];
    gap[i] = height - height == 0.0 ? top - height : GapField::kInvalidGap;
  }
}

MEMS_STICTION_VECTORIZED void gapsBelow(double top, const float* line, std::size_t size, double* gap) {
  gapsBelowLine(top, line, size, gap);
}
MEMS_STICTION_VECTORIZED void gapsBelow(double top, const double* line, std::size_t size, double* gap) {
  gapsBelowLine(top, line, size, gap);
}

/// Count, sum, sum of squares and maximum of the finite gaps, in fixed lanes.
struct GapSums {
  Lanes count{};
  Lanes sum{};
  Lanes squares{};
  Lanes largest{};
};

/// @param size a multiple of kLanes
MEMS_STICTION_VECTORIZED void addGaps(const double* gaps, std::size_t size, GapSums& sums) {
  const Lanes zero{};
  const Lanes one = zero + 1.0;
  GapSums local = sums;
  for (std::size_t i = 0; i < size; i += kLanes) {
    Lanes gap;
    load(gaps + i, gap);
    const auto is_valid = gap < GapField::kInvalidGap;
    const Lanes value = is_valid ? gap : zero;
    local.count += is_valid ? one : zero;
    local.sum += value;
    local.squares += value * value;
    local.largest = value > local.largest ? value : local.largest;
  }
  sums = local;
}

}  // namespace

template <typename Scalar>
void GapField::computeAgainstPlane(const cv::Mat& heights) {
  Scalar highest = -std::numeric_limits<Scalar>::max();
  for (int row = 0; row < rows_; ++row) {
    highest = std::max(highest, highestOf(heights.ptr<Scalar>(row), static_cast<std::size_t>(cols_)));
  }
  double* gap = gap_.data();
  for (int row = 0; row < rows_; ++row, gap += cols_) {
    gapsBelow(highest, heights.ptr<Scalar>(row), static_cast<std::size_t>(cols_), gap);
  }
}

void GapField::compute(const HeightMap& lower) {
  rows_ = lower.rows();
  cols_ = lower.cols();
  pitch_x_ = lower.pitchX();
  pitch_y_ = lower.pitchY();
  upper_is_flat_ = true;
  gap_.resize(static_cast<std::size_t>(cellCount()));
  if (lower.heights().depth() == CV_32F) {
    computeAgainstPlane<float>(lower.heights());
  } else {
    computeAgainstPlane<double>(lower.heights());
  }
  measure();
}

MEMS_STICTION_VECTORIZED int GapField::columnsBelow(double limit, int row, std::int32_t* columns) const {
  // Surfaces are smooth on the scale of a few cells: blocks that are wholly above or below the limit are frequent.
  constexpr std::int32_t kBlock = 8;
  const double* gap = gap_.data() + static_cast<std::ptrdiff_t>(row) * cols_;
  std::int32_t* next = columns;
  std::int32_t col = 0;
  for (; col + kBlock <= cols_; col += kBlock, gap += kBlock) {
    Lanes low;
    Lanes high;
    load(gap, low);
    load(gap + kLanes, high);
    const LaneMask below_low = low < limit;
    const LaneMask below_high = high < limit;
    const LaneMask sums = below_low + below_high;  // minus their number
    const std::int64_t count = -(sums[0] + sums[1] + sums[2] + sums[3]);
    if (count == 0) continue;
    if (count == kBlock) {
      for (std::int32_t i = 0; i < kBlock; ++i) next[i] = col + i;
      next += kBlock;
      continue;
    }
    for (std::int32_t i = 0; i < kBlock; ++i) {  // which ones is random: written without a branch
      *next = col + i;
      next += gap[i] < limit ? 1 : 0;
    }
  }
  for (; col < cols_; ++col, ++gap) {
    *next = col;
    next += *gap < limit ? 1 : 0;
  }
  return static_cast<int>(next - columns);
}

template <typename LowerScalar, typename UpperScalar>
double GapField::separate(const HeightMap& lower, const HeightMap& upper) {
  double closest = kInvalidGap;
  double reference = kInvalidGap;
  std::size_t cell = 0;
  for (int row = 0; row < rows_; ++row) {
    const LowerScalar* line1 = lower.heights().ptr<LowerScalar>(row);
    const UpperScalar* line2 = upper.heights().ptr<UpperScalar>(row);
    for (int col = 0; col < cols_; ++col, ++cell) {
      const double height = line1[col];
      const double separation = line2[col] - height;
      if (std::isfinite(separation)) {
        if (reference == kInvalidGap) reference = height;
        gap_[cell] = separation;
        lower_[cell] = height - reference;
        closest = std::min(closest, separation);
      } else {
        gap_[cell] = kInvalidGap;
        lower_[cell] = 0.0;
      }
    }
  }
  return closest;
}

void GapField::compute(const HeightMap& lower, const HeightMap& upper) {
  requireSameGrid(lower, upper);
  rows_ = lower.rows();
  cols_ = lower.cols();
  pitch_x_ = lower.pitchX();
  pitch_y_ = lower.pitchY();
  upper_is_flat_ = false;
  gap_.resize(static_cast<std::size_t>(cellCount()));
  lower_.resize(gap_.size());

  const bool lower_is_single = lower.heights().depth() == CV_32F;
  const bool upper_is_single = upper.heights().depth() == CV_32F;
  const double closest =
      lower_is_single
          ? (upper_is_single ? separate<float, float>(lower, upper) : separate<float, double>(lower, upper))
          : (upper_is_single ? separate<double, float>(lower, upper) : separate<double, double>(lower, upper));
  for (double& gap : gap_) gap -= closest == kInvalidGap ? 0.0 : closest;
  measure();
}

void GapField::measure() {
  GapSums sums;
  const std::size_t in_lanes = gap_.size() / kLanes * kLanes;
  addGaps(gap_.data(), in_lanes, sums);
  double rest[kLanes];
  std::fill(rest, rest + kLanes, kInvalidGap);
  std::copy(gap_.begin() + static_cast<std::ptrdiff_t>(in_lanes), gap_.end(), rest);
  addGaps(rest, kLanes, sums);

  valid_count_ = static_cast<int>(sumOf(sums.count));
  if (valid_count_ == 0) {
    throw SurfaceError(upper_is_flat_ ? "the height map has no valid pixel"
                                      : "no pixel is valid in both the scan and the counter-surface");
  }
  largest_gap_ = largestOf(sums.largest);
  mean_gap_ = sumOf(sums.sum) / valid_count_;
  const double mean_square = sumOf(sums.squares) / valid_count_;
  rms_gap_ = std::sqrt(std::max(0.0, mean_square - mean_gap_ * mean_gap_));
}

}  // namespace mems_stiction
