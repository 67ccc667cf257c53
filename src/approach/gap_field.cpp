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
  double highest = -kInvalidGap;
  for (int row = 0; row < rows_; ++row) {
    const Scalar* line = heights.ptr<Scalar>(row);
    for (int col = 0; col < cols_; ++col) {
      if (std::isfinite(line[col])) highest = std::max(highest, static_cast<double>(line[col]));
    }
  }
  double* gap = gap_.data();
  for (int row = 0; row < rows_; ++row) {
    const Scalar* line = heights.ptr<Scalar>(row);
    for (int col = 0; col < cols_; ++col, ++gap) {
      *gap = std::isfinite(line[col]) ? highest - static_cast<double>(line[col]) : kInvalidGap;
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
  finish();
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

  const cv::Mat z1 = lower.asDouble().heights();
  const cv::Mat z2 = upper.asDouble().heights();
  double closest = kInvalidGap;
  double reference = kInvalidGap;
  std::size_t cell = 0;
  for (int row = 0; row < rows_; ++row) {
    const double* line1 = z1.ptr<double>(row);
    const double* line2 = z2.ptr<double>(row);
    for (int col = 0; col < cols_; ++col, ++cell) {
      const double separation = line2[col] - line1[col];
      if (std::isfinite(separation)) {
        if (reference == kInvalidGap) reference = line1[col];
        gap_[cell] = separation;
        lower_[cell] = line1[col] - reference;
        closest = std::min(closest, separation);
      } else {
        gap_[cell] = kInvalidGap;
        lower_[cell] = 0.0;
      }
    }
  }
  for (double& gap : gap_) gap -= closest == kInvalidGap ? 0.0 : closest;
  finish();
}

void GapField::finish() {
  valid_count_ = 0;
  largest_gap_ = 0.0;
  double sum = 0.0;
  for (const double gap : gap_) {
    if (gap == kInvalidGap) continue;
    ++valid_count_;
    largest_gap_ = std::max(largest_gap_, gap);
    sum += gap;
  }
  if (valid_count_ == 0) {
    throw SurfaceError(upper_is_flat_ ? "the height map has no valid pixel"
                                      : "no pixel is valid in both the scan and the counter-surface");
  }
  mean_gap_ = sum / valid_count_;
}

}  // namespace mems_stiction
