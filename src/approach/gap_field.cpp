#include "mems_stiction/approach/gap_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"

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

}  // namespace

template <typename Scalar>
void GapField::computeAgainstPlane(const cv::Mat& heights) {
  constexpr Scalar kLargest = std::numeric_limits<Scalar>::max();
  constexpr int kLanes = 8;  // independent maxima, which the compiler turns into vector instructions
  Scalar highest[kLanes];
  std::fill(highest, highest + kLanes, -kLargest);
  for (int row = 0; row < rows_; ++row) {
    const Scalar* line = heights.ptr<Scalar>(row);
    int col = 0;
    for (; col + kLanes <= cols_; col += kLanes) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const Scalar height = line[col + lane];
        const bool is_higher = height > highest[lane] && height <= kLargest;  // false for NaN and infinity
        highest[lane] = is_higher ? height : highest[lane];
      }
    }
    for (; col < cols_; ++col) {
      if (line[col] > highest[0] && line[col] <= kLargest) highest[0] = line[col];
    }
  }
  const double top = *std::max_element(highest, highest + kLanes);
  double* gap = gap_.data();
  for (int row = 0; row < rows_; ++row, gap += cols_) {
    const Scalar* line = heights.ptr<Scalar>(row);
    for (int col = 0; col < cols_; ++col) {
      const double height = line[col];
      gap[col] = height - height == 0.0 ? top - height : kInvalidGap;
    }
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
  constexpr std::size_t kLanes = 4;  // independent sums, which the compiler turns into vector instructions
  double count[kLanes] = {};
  double sum[kLanes] = {};
  double squares[kLanes] = {};
  double largest[kLanes] = {};
  const std::size_t size = gap_.size();
  const auto add = [&](std::size_t lane, double gap) {
    const bool is_valid = gap < kInvalidGap;
    const double value = is_valid ? gap : 0.0;
    count[lane] += is_valid ? 1.0 : 0.0;
    sum[lane] += value;
    squares[lane] += value * value;
    largest[lane] = value > largest[lane] ? value : largest[lane];
  };
  std::size_t cell = 0;
  for (; cell + kLanes <= size; cell += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) add(lane, gap_[cell + lane]);
  }
  for (; cell < size; ++cell) add(0, gap_[cell]);

  valid_count_ = static_cast<int>(count[0] + count[1] + count[2] + count[3]);
  if (valid_count_ == 0) {
    throw SurfaceError(upper_is_flat_ ? "the height map has no valid pixel"
                                      : "no pixel is valid in both the scan and the counter-surface");
  }
  largest_gap_ = *std::max_element(largest, largest + kLanes);
  mean_gap_ = (sum[0] + sum[1] + sum[2] + sum[3]) / valid_count_;
  const double mean_square = (squares[0] + squares[1] + squares[2] + squares[3]) / valid_count_;
  rms_gap_ = std::sqrt(std::max(0.0, mean_square - mean_gap_ * mean_gap_));
}

}  // namespace mems_stiction
