#include "source/stage_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

/// Share of the steps that are no longer than the usual one.
constexpr double kUsualShare = 0.9;

/// A stage that has gone so many steps has moved; noise goes less than three and a half.
constexpr double kStepsOfMove = 4.0;

/// A stage that has gone less than this share of a step further has not gone on.
constexpr double kStandingShare = 0.1;

}  // namespace

double StageWay::leastMove() const { return kStepsOfMove * step_; }

void StageWay::takeStep(double step) {
  if (!has_own_step_ || step == 0.0) return;
  steps_.push_back(step);
  if (steps_.size() < renewed_at_) return;
  renewed_at_ = steps_.size() + steps_.size() / 10 + 1;
  const auto usual = steps_.begin() +
                     static_cast<std::ptrdiff_t>(kUsualShare * static_cast<double>(steps_.size()));
  std::nth_element(steps_.begin(), usual, steps_.end());
  step_ = *usual;
}

bool StageWay::add(double place) {
  const std::size_t line = lines_++;
  if (line == 0) {
    first_ = last_ = low_ = high_ = furthest_ = place;
    return true;
  }
  takeStep(std::abs(place - last_));
  last_ = place;
  low_ = std::min(low_, place);
  high_ = std::max(high_, place);
  const double further = direction_ == 0 ? std::abs(place - first_) - std::abs(furthest_ - first_)
                                         : direction_ * (place - furthest_);
  const bool has_turned = direction_ != 0 && -further > leastMove();
  if (has_turned) {
    turns_.push_back(furthest_line_ + 1);
    direction_ = -direction_;
  } else if (!(further > kStandingShare * step_)) {
    return false;
  } else if (direction_ == 0 && std::abs(place - first_) > leastMove()) {
    direction_ = place > first_ ? 1 : -1;
  }
  furthest_ = place;
  furthest_line_ = line;
  return true;
}

std::vector<double> slacks(const std::vector<double>& places, double backlash, double line_pitch) {
  StageWay way(line_pitch);
  for (const double place : places) way.add(place);
  bool falls = way.fallsFirst();
  double stood_at =
      falls ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  auto turn = way.turns().begin();
  std::vector<double> slacks;
  for (std::size_t line = 0; line < places.size(); ++line) {
    if (turn != way.turns().end() && *turn == line) {
      stood_at = places[line - 1] + slacks.back();
      falls = !falls;
      ++turn;
    }
    const double rest = stood_at - places[line];
    slacks.push_back(falls ? std::min(backlash, rest) : std::max(0.0, rest));
  }
  return slacks;
}

}  // namespace mems_stiction
