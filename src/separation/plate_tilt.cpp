#include "separation/plate_tilt.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "loads/force_range.hpp"
#include "mems_stiction/errors/errors.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

constexpr int kMostTiltTrials = 60;
/// Damping of the second moments, and the least of trusted heights, as a part of the reach.
constexpr double kDamping = 1e-4;
constexpr double kLeastTrust = 1e-6;

/// Heights at the frame's ends that a change of slopes makes [m].
double heightOf(const PlaneSlopes& change, const GapField& field) {
  return 0.5 * (std::abs(change.x) * field.cols() * field.pitchX() +
                std::abs(change.y) * field.rows() * field.pitchY());
}

}  // namespace

double PlateTilt::Balance::share() const {
  return largest > 0.0 ? std::hypot(x, y) / largest : 0.0;
}

void PlateTilt::tiltTo(const GapField& level, const PlaneSlopes& slopes) {
  plane_.create(level.rows(), level.cols());
  for (int row = 0; row < level.rows(); ++row) {
    double* const heights = plane_[row];
    for (int col = 0; col < level.cols(); ++col) {
      const PlaceOnPlate place = placeOnPlate(level, level.cellAt(row, col));
      heights[col] = slopes.x * place.x + slopes.y * place.y;
    }
  }
  tilted_.lower(level, plane_);
}

void PlateTilt::addPatches(Balance& balance) {
  const double approach = curve_.rest().approach;
  const OverlapSweep& sweep = curve_.frame().contactsAt(approach);
  overlaps_.assign(curve_.contacts().size(), 0.0);
  sums_.assign(curve_.contacts().size(), {});
  for (int i = 0; i < sweep.cellCount(); ++i) {
    const OrderedCell& ordered = curve_.frame().orderedCells()[static_cast<std::size_t>(i)];
    const auto patch = static_cast<std::size_t>(sweep.livePlace(sweep.patchOf(ordered)));
    const PlaceOnPlate place = placeOnPlate(tilted_, tilted_.cellAt(ordered.cell));
    const double overlap = approach - ordered.gap;
    overlaps_[patch] += overlap;
    sums_[patch].x += overlap * place.x;
    sums_[patch].y += overlap * place.y;
  }
  double x = 0.0;
  double y = 0.0;
  for (std::size_t i = 0; i < overlaps_.size(); ++i) {
    const double load = curve_.contacts()[i].load.carried;
    const PlaceOnPlate place{sums_[i].x / overlaps_[i], sums_[i].y / overlaps_[i]};
    const double stiffness = 0.75 * load / sweep.patches()[i].depth(approach);
    balance.x += load * place.x;
    balance.y += load * place.y;
    balance.largest += load * std::hypot(place.x, place.y);
    balance.stiffness += stiffness;
    x += stiffness * place.x;
    y += stiffness * place.y;
    balance.xx += stiffness * place.x * place.x;
    balance.xy += stiffness * place.x * place.y;
    balance.yy += stiffness * place.y * place.y;
  }
  if (!(balance.stiffness > 0.0)) return;
  balance.xx -= x * x / balance.stiffness;
  balance.xy -= x * y / balance.stiffness;
  balance.yy -= y * y / balance.stiffness;
}

void PlateTilt::addAttraction(const ContactSettings& settings, Balance& balance) {
  const SeparationState& rest = curve_.rest();
  const ContactTraction& law = curve_.frame().law();
  const FieldLaw field = fieldLaw(settings.load.fieldVoltage(), settings.interface);
  const WaterLaw water = settings.capillary.law();
  Balance adhesion;
  Balance loads;
  double sum = 0.0;
  for (int row = 0; row < tilted_.rows(); ++row) {
    tilted_.gapsOfRow(row, line_.data());
    for (int col = 0; col < tilted_.cols(); ++col) {
      const double gap = line_[static_cast<std::size_t>(col)] - rest.approach;
      if (!(gap <= tilted_.largestGap())) continue;  // nor where nothing was measured
      const PlaceOnPlate place = placeOnPlate(tilted_, tilted_.cellAt(row, col));
      if (gap > 0.0) {
        const double traction = law.traction(gap);
        sum += traction;
        adhesion.x += traction * place.x;
        adhesion.y += traction * place.y;
        adhesion.largest += traction * std::hypot(place.x, place.y);
      }
      double pressure = water.pressure(gap);
      if (field.isOn()) pressure += field.pressure(std::max(gap, 0.0));
      loads.x += pressure * place.x;
      loads.y += pressure * place.y;
    }
  }
  // bending and what contacts open take from all of it alike
  const double factor = sum > 0.0 ? rest.adhesion / sum : 0.0;
  balance.x -= factor * adhesion.x + tilted_.cellArea() * loads.x;
  balance.y -= factor * adhesion.y + tilted_.cellArea() * loads.y;
  balance.largest += factor * adhesion.largest;
}

PlateTilt::Balance PlateTilt::balanceAt(const GapField& level, const PlaneSlopes& slopes,
                                        const ContactSettings& settings) {
  tiltTo(level, slopes);
  curve_.comeToRest(tilted_, settings);
  Balance balance;
  addPatches(balance);
  addAttraction(settings, balance);
  balance.reach = curve_.frame().law().range() + std::max(curve_.rest().approach, 0.0);
  return balance;
}

const GapField& PlateTilt::settle(const GapField& level, const ContactSettings& settings) {
  const std::optional<PlaneSlopes> support = supportPlane(level);
  if (!support) {
    throw SurfaceError(
        "device/guidance: free: no three places surround the middle of the frame, on which a plate "
        "could rest");
  }
  line_.resize(static_cast<std::size_t>(level.cols()));
  slopes_ = *support;
  Balance balance = balanceAt(level, slopes_, settings);
  double trust = balance.reach;
  bool is_here = true;  // the plate stands as it is known to be best
  is_tipped_ = false;
  const double highest = heightOf(slopes_, level) + level.largestGap() + balance.reach;
  for (int trial = 0; trial < kMostTiltTrials && balance.share() > chosen::kAccuracy; ++trial) {
    const double width = level.cols() * level.pitchX();
    const double height = level.rows() * level.pitchY();
    const double xx = balance.xx + kDamping * balance.stiffness * width * width;
    const double yy = balance.yy + kDamping * balance.stiffness * height * height;
    const double determinant = xx * yy - balance.xy * balance.xy;
    if (!(determinant > 0.0)) break;
    PlaneSlopes step{(yy * balance.x - balance.xy * balance.y) / determinant,
                     (xx * balance.y - balance.xy * balance.x) / determinant};
    const double length = heightOf(step, level);
    const double shorter = std::min(1.0, trust / length);
    const PlaneSlopes next{slopes_.x + shorter * step.x, slopes_.y + shorter * step.y};
    if (heightOf(next, level) > highest) {
      is_tipped_ = true;
      break;
    }
    const Balance there = balanceAt(level, next, settings);
    // energy falls along the step as long as the moments go with it: a plate on two contacts tips
    // until a third one carries
    is_here = there.share() < balance.share() || there.x * step.x + there.y * step.y > 0.0;
    if (is_here) {
      slopes_ = next;
      balance = there;
      trust = std::max(trust, 2.0 * shorter * length);
      continue;
    }
    trust = 0.3 * shorter * length;
    if (trust < kLeastTrust * balance.reach) break;
  }
  if (!is_here) tiltTo(level, slopes_);
  return tilted_;
}

}  // namespace mems_stiction
