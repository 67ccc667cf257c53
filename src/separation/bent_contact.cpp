#include "separation/bent_contact.hpp"

#include <algorithm>
#include <cmath>

#include "separation/chosen_constants.hpp"

namespace mems_stiction {
namespace {

constexpr int kMostTrials = 12;

/// The next step of a way [m].
/// - @p length of it so far: bodies that are soft are drawn out far
double stepFrom(const SeparationState& state, double length, double range) {
  return chosen::kStep * (range + std::max(std::abs(state.approach), length));
}

}  // namespace

SeparationState BentContact::approached(double height) {
  SeparationState state = plate_.settle(height, {height, 0.0});
  const double load = settings_->load.mechanical_load;
  for (int i = 0; i < kMostTrials && !plate_.hasSettled() && state.force() + load < 0.0; ++i) {
    state = plate_.settle(height, {height, 0.0});
  }
  return state;
}

void BentContact::settleBetween(double above, double below) {
  const double load = settings_->load.mechanical_load;
  const cv::Mat1d from = plate_.shape().clone();
  for (int trial = 0; trial < kMostTrials; ++trial) {
    const double middle = 0.5 * (above + below);
    plate_.takeBack(from);
    const SeparationState state = approached(middle);
    if (std::abs(state.force() + load) <= chosen::kAccuracy * std::max(state.carried, load)) {
      height_at_rest_ = middle;
      return;
    }
    (state.force() + load >= 0.0 ? above : below) = middle;
    height_at_rest_ = middle;
  }
}

void BentContact::comeToRest() {
  const double load = settings_->load.mechanical_load;
  const double range = curve_.frame().law().range();
  double height = field_->meanGap() + chosen::kApart * range;
  way_in_.states.clear();
  cv::Mat1d before;
  double above = height;
  for (int step = 0; step < settings_->approach.max_steps; ++step) {
    plate_.shape().copyTo(before);
    const SeparationState state = approached(height);
    way_in_.states.push_back(state);
    height_at_rest_ = height;
    if (state.force() + load < 0.0) {
      plate_.takeBack(before);
      settleBetween(above, height);
      way_in_.states.push_back(plate_.state());
      break;
    }
    if (state.contact_count >= plate_.frame().contactLimit()) break;
    above = height;
    height -= chosen::kStepsIn * stepFrom(state, 0.0, range);
  }
  at_rest_ = plate_.blocks();
  energy_at_rest_ = plate_.energy();
}

void BentContact::flow(const GapField& at_rest) {
  curve_.comeToRest(at_rest, *settings_);
  const double approach = curve_.rest().approach;
  flowed_.create(field_->rows(), field_->cols());
  flowed_ = 0.0;
  const OverlapSweep& sweep = curve_.frame().contactsAt(approach);
  bool has_flowed = false;
  for (int i = 0; i < sweep.cellCount(); ++i) {
    const OrderedCell& ordered = curve_.frame().orderedCells()[static_cast<std::size_t>(i)];
    const auto contact = static_cast<std::size_t>(sweep.livePlace(sweep.patchOf(ordered)));
    const RemainingOverlap& remaining = curve_.contacts()[contact].remaining;
    if (!remaining.isChanged()) continue;
    has_flowed = true;
    const GridCell cell = field_->cellAt(ordered.cell);
    flowed_(cell.row, cell.col) = approach - ordered.gap - remaining.of(approach - ordered.gap);
  }
  if (!has_flowed) return;
  changed_.lower(*field_, flowed_);
  height_at_rest_ += cv::sum(flowed_)[0] / field_->validCount();  // heights count from the mean
  plate_.change(changed_);
}

void BentContact::part() {
  parting_ = {};
  strongest_ = at_rest_.clone();  // where nothing holds
  const double range = plate_.frame().law().range();
  const double most = plate_.frame().law().workOfAdhesion();
  const Way way = wayOutOf(way_in_, range);
  const double level = field_->meanGap();
  const auto take = [&](double height) {
    const double force = plate_.state().partingForce();
    if (force > parting_.force) {
      parting_.force = force;
      strongest_ = plate_.blocks();
    }
    parting_.curve.push_back({level - height, force, true});
  };
  double height = height_at_rest_;
  SeparationState state = plate_.settle(height, {height, way.longest_hold});
  take(height);
  cv::Mat1d before;
  double work = 0.0;
  double rise = 0.0;
  double longest = stepFrom(state, height - height_at_rest_, range);
  while (state.approach > -chosen::kApart * range) {
    plate_.shape().copyTo(before);
    double step = longest;
    SeparationState next = plate_.settle(height + step, {height_at_rest_, way.longest_hold});
    // where bodies jump out of a valley in which the force would have become the largest, how far the valley goes
    const bool falls = next.partingForce() < state.partingForce();
    if (falls && state.partingForce() + rise * step > parting_.force &&
        step > chosen::kShortestStep * stepFrom(state, height - height_at_rest_, range)) {
      plate_.takeBack(before);
      longest = 0.5 * step;
      continue;
    }
    height += step;
    take(height);
    work += 0.5 * step * (std::max(0.0, state.givenForce()) + std::max(0.0, next.givenForce()));
    rise = std::max(0.0, next.partingForce() - state.partingForce()) / step;
    state = next;
    longest = stepFrom(state, height - height_at_rest_, range);
  }
  work += plate_.frame().energy(state.approach);
  parting_.work = std::min(work / plate_.frame().area(), most);
}

bool BentContact::staysStraight() {
  curve_.comeToRest(*field_, *settings_);
  curve_.part();
  plate_.start(bending_, *field_, *settings_);
  const double level = field_->meanGap();
  const double rest = level - curve_.rest().approach;
  const double least = chosen::kLeastBending * curve_.frame().law().range();
  return plate_.firstMove(rest, {rest, 0.0}) < least &&
         plate_.firstMove(level - curve_.wayOut().pull_off_approach, {rest, curve_.wayOut().way.longest_hold}) < least;
}

const BentContact::Parting& BentContact::parting() {
  if (!has_parted_) {
    flow(bending_.bentBy(*field_, at_rest_));
    part();
    has_parted_ = true;
  }
  return parting_;
}

const GapField& BentContact::solve(const GapField& field, const ContactSettings& settings) {
  field_ = &field;
  settings_ = &settings;
  bending_.start(field, WaveStiffness(settings.lower, settings.upper));
  is_stiff_ = staysStraight();
  if (is_stiff_) return field;
  has_parted_ = false;
  comeToRest();
  return bending_.bentBy(field, at_rest_);
}

}  // namespace mems_stiction
