#include "separation/pressed_plate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// Steps at one height before what has been found counts, and parts of one step.
constexpr int kMostSteps = 8;
constexpr int kMostShorter = 2;
/// Of conjugate gradients, and the share of the residual that they leave: the next step takes the rest.
constexpr int kMostProducts = 30;
constexpr double kLeftOver = 0.3;
/// Below this share of the bodies' own stiffness there is no equilibrium near by.
constexpr double kLeastCurvature = 0.01;
/// What bodies that have settled may still move, as a share of the law's range.
constexpr double kSettled = 0.01;

int blockOf(int cell, int blocks, int cells) {
  return static_cast<int>(static_cast<std::int64_t>(cell) * blocks / cells);
}

}  // namespace

void PressedPlate::start(PlateBending& bending, const GapField& field, const ContactSettings& settings) {
  bending_ = &bending;
  field_ = &field;
  settings_ = &settings;
  flows_ = true;
  shape_.create(bending.waves().weighedSize());
  shape_ = 0.0;
}

void PressedPlate::change(const GapField& field) {
  field_ = &field;
  flows_ = false;
}

double PressedPlate::energy() const { return 0.5 * shape_.dot(shape_) / static_cast<double>(shape_.total()); }

void PressedPlate::stateOf(double height, const HeightWay& way) {
  bending_->root(shape_, rooted_);
  rooted_(cv::Rect({0, 0}, bending_->waves().blocks())).copyTo(blocks_);
  bent_ = &bending_->bentBy(*field_, blocks_);
  frame_.start(*bent_, *settings_, nullptr, flows_);
  const double approach = bent_->meanGap() - height;
  state_ = stateAt(frame_, approach, {approach + height - way.rest, way.longest_hold});
}

void PressedPlate::mirror(cv::Mat1d& blocks, cv::Mat1d& all) const {
  if (bending_->waves().repeats()) {
    blocks.copyTo(all);
    return;
  }
  cv::copyMakeBorder(blocks, all, 0, blocks.rows, 0, blocks.cols, cv::BORDER_REFLECT);
}

void PressedPlate::takeForces() {
  const GapField& gaps = *bent_;
  const cv::Size blocks = bending_->waves().blocks();
  const double block_area = bending_->waves().blockArea();
  for (cv::Mat1d* image : {&pressure_block_, &stiffness_block_, &softness_block_}) {
    image->create(blocks);
    *image = 0.0;
  }
  const double approach = state_.approach;
  // what attracts; bending of summits and what contacts open take from all of it alike
  const ContactTraction& law = frame_.law();
  line_.resize(static_cast<std::size_t>(gaps.cols()));
  columns_.resize(line_.size());
  for (int col = 0; col < gaps.cols(); ++col) {
    columns_[static_cast<std::size_t>(col)] = blockOf(col, blocks.width, gaps.cols());
  }
  const double deepest = gaps.largestGap() - approach;
  double sum = 0.0;
  for (int row = 0; row < gaps.rows(); ++row) {
    gaps.gapsOfRow(row, line_.data());
    const int block_row = blockOf(row, blocks.height, gaps.rows());
    double* const line = pressure_block_[block_row];
    double* const softness = softness_block_[block_row];
    for (int col = 0; col < gaps.cols(); ++col) {
      const double gap = line_[static_cast<std::size_t>(col)] - approach;
      if (!(gap > 0.0) || !(gap <= deepest)) continue;  // nor where nothing was measured
      const double traction = law.traction(gap);
      sum += traction;
      const int block = columns_[static_cast<std::size_t>(col)];
      line[block] -= traction;
      softness[block] += law.slope(gap);
    }
  }
  const double factor = sum > 0.0 ? state_.adhesion / sum / block_area : 0.0;
  pressure_block_ *= factor;
  softness_block_ *= factor;
  if (state_.contact_count > 0) {
    const OverlapSweep& sweep = frame_.contactsAt(approach);
    frame_.patchForces().loadsOf(sweep, approach, loads_);
    overlaps_.assign(loads_.size(), 0.0);
    const auto patchOf = [&](const OrderedCell& ordered) {
      return static_cast<std::size_t>(sweep.livePlace(sweep.patchOf(ordered)));
    };
    for (int i = 0; i < sweep.cellCount(); ++i) {
      const OrderedCell& ordered = frame_.orderedCells()[static_cast<std::size_t>(i)];
      overlaps_[patchOf(ordered)] += approach - ordered.gap;
    }
    for (int i = 0; i < sweep.cellCount(); ++i) {
      const OrderedCell& ordered = frame_.orderedCells()[static_cast<std::size_t>(i)];
      const std::size_t patch = patchOf(ordered);
      if (!(overlaps_[patch] > 0.0)) continue;
      const GridCell cell = gaps.cellAt(ordered.cell);
      const cv::Point block(blockOf(cell.col, blocks.width, gaps.cols()),
                            blockOf(cell.row, blocks.height, gaps.rows()));
      const double load = loads_[patch].carried * (approach - ordered.gap) / overlaps_[patch] / block_area;
      const double cells = sweep.patches()[patch].cells;
      pressure_block_(block) += load;
      stiffness_block_(block) +=
          0.75 * loads_[patch].carried / sweep.patches()[patch].depth(approach) / cells / block_area;
    }
  }
  mirror(pressure_block_, pressure_);
  mirror(stiffness_block_, stiffness_);
  softness_block_ += stiffness_block_;
  mirror(softness_block_, total_stiffness_);
}

void PressedPlate::takeResidual() {
  takeForces();
  bending_->root(pressure_, rooted_);
  cv::subtract(rooted_, shape_, residual_);
}

void PressedPlate::findStep() {
  if (!solve(total_stiffness_)) solve(stiffness_);
}

bool PressedPlate::solve(const cv::Mat1d& stiffness) {
  step_.create(residual_.size());
  step_ = 0.0;
  residual_.copyTo(left_);
  residual_.copyTo(direction_);
  double square = left_.dot(left_);
  const double enough = kLeftOver * kLeftOver * square;
  for (int i = 0; i < kMostProducts && square > enough; ++i) {
    bending_->root(direction_, rooted_);
    cv::multiply(rooted_, stiffness, rooted_);
    bending_->root(rooted_, product_);
    product_ += direction_;
    const double curvature = direction_.dot(product_);
    if (!(curvature > kLeastCurvature * direction_.dot(direction_))) return false;
    const double length = square / curvature;
    cv::scaleAdd(direction_, length, step_, step_);
    cv::scaleAdd(product_, -length, left_, left_);
    const double next = left_.dot(left_);
    cv::scaleAdd(direction_, next / square, left_, direction_);
    square = next;
  }
  return true;
}

double PressedPlate::firstMove(double height, const HeightWay& way) {
  stateOf(height, way);
  takeResidual();
  findStep();
  bending_->root(step_, rooted_);
  return cv::norm(rooted_, cv::NORM_INF);
}

const SeparationState& PressedPlate::settle(double height, const HeightWay& way) {
  stateOf(height, way);
  takeResidual();
  const double range = frame_.law().range();
  has_settled_ = false;
  for (int i = 0; i < kMostSteps; ++i) {
    findStep();
    bending_->root(step_, rooted_);
    if (std::sqrt(rooted_.dot(rooted_) / static_cast<double>(rooted_.total())) <= kSettled * range) {
      has_settled_ = true;
      break;
    }
    shape_.copyTo(from_);
    const double along = residual_.dot(step_);
    double part = 1.0;
    for (int shorter = 0;; ++shorter) {
      cv::scaleAdd(step_, part, from_, shape_);
      stateOf(height, way);
      takeResidual();
      const double there = residual_.dot(step_);
      if (shorter == kMostShorter || there >= -0.5 * along) break;
      // where a line through both vanishes
      part *= std::max(0.1, along / (along - there));
    }
  }
  return state_;
}

}  // namespace mems_stiction
