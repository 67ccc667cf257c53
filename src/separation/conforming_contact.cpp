#include "mems_stiction/separation/conforming_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

/// Radius of the weakest place, whose short waves count, in cohesive lengths (doc/separation_curve.md).
constexpr double kPlaceRadius = 3.0;

/// k = 2 U/(A sigma^2); bodies without relief have nothing to give way.
double stiffnessOf(double flattening_energy, double rms_height) {
  return flattening_energy > 0.0 && rms_height > 0.0 ? 2.0 * flattening_energy / (rms_height * rms_height)
                                                     : std::numeric_limits<double>::infinity();
}

}  // namespace

void ConformingContact::start(const GapField& field, const ContactTraction& law, const ConformingBodies& bodies) {
  field_ = &field;
  law_ = &law;
  bodies_ = bodies;
  has_relief_ = false;
  ReliefClasses depths(0.0, field.largestGap());
  line_.resize(static_cast<std::size_t>(field.cols()));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line_.data());
    for (const double gap : line_) {
      if (gap <= field.largestGap()) depths.add(gap);
    }
  }
  branch_ = springBranch(depths.classes(), law, stiffnessOf(bodies.flattening_energy, field.rmsGap()));
}

double ConformingContact::work() const { return std::max(0.0, -restOf(branch_, 0.0)->energy); }

BondedBodies ConformingContact::bondedBodies() const {
  return {bodies_.contact_modulus, law_->workOfAdhesion(), law_->range(), bodies_.flattening_energy, field_->rmsGap()};
}

ReliefSpectrum& ConformingContact::relief() {
  if (!has_relief_) relief_.take(*field_, ReliefWaves::blockLength(bondedBodies().cohesiveLength()));
  has_relief_ = true;
  return relief_;
}

bool ConformingContact::hasOpenValleys(double pressure) {
  const BondedBodies bodies = bondedBodies();
  if (!(bodies.flattening_energy > 0.0 && bodies.rms_height > 0.0)) return false;
  return valleysStayOpen(relief(), bodies, pressure);
}

double ConformingContact::takeShortWaves(cv::Point2d place, double radius) {
  const cv::Mat1d& long_heights = waves_.longHeights();
  const bool repeats = relief().repeats();
  const auto distance = [repeats](double from, double to, int count, double pitch) {
    const double cells = std::abs(from - to);
    return pitch * (repeats ? std::min(cells, count - cells) : cells);
  };
  depths_at_place_.clear();
  double count = 0.0;
  double sum = 0.0;
  double square_sum = 0.0;
  for (int row = 0; row < field_->rows(); ++row) {
    field_->gapsOfRow(row, line_.data());
    const double along_y = distance(row + 0.5, place.y, field_->rows(), field_->pitchY());
    for (int col = 0; col < field_->cols(); ++col) {
      const double gap = line_[static_cast<std::size_t>(col)];
      if (!(gap <= field_->largestGap())) continue;
      const double depth = gap - field_->meanGap() + long_heights(row, col);
      count += 1.0;
      sum += depth;
      square_sum += depth * depth;
      if (along_y > radius) continue;
      const double along_x = distance(col + 0.5, place.x, field_->cols(), field_->pitchX());
      if (std::hypot(along_x, along_y) <= radius) depths_at_place_.push_back(depth);
    }
  }
  return std::sqrt(std::max(square_sum / count - sum * sum / (count * count), 0.0));
}

double ConformingContact::strengthAtWeakestPlace() {
  const double cohesive_length = bondedBodies().cohesiveLength();
  waves_.split(relief(), {field_->cols(), field_->rows()}, bodies_.contact_modulus, cohesive_length);
  const double cell = std::hypot(field_->pitchX(), field_->pitchY());
  const double short_rms = takeShortWaves(waves_.weakestPlace(), std::max(kPlaceRadius * cohesive_length, cell));
  const double short_energy = flattening_.of(*field_, waves_.longHeights(), bodies_.contact_modulus);
  if (depths_at_place_.empty()) return law_->strength() - waves_.largestTension();  // pixels without a height
  const auto [lowest, highest] = std::minmax_element(depths_at_place_.begin(), depths_at_place_.end());
  ReliefClasses depths(*lowest, *highest);
  for (const double depth : depths_at_place_) depths.add(depth);
  const std::vector<SpringState> branch = springBranch(depths.classes(), *law_, stiffnessOf(short_energy, short_rms));
  return strengthFrom(branch.begin(), branch) - waves_.largestTension();
}

double ConformingContact::closedStrength(double pressure) {
  return std::min(strengthFrom(restOf(branch_, pressure), branch_), strengthAtWeakestPlace());
}

ConformingWayOut ConformingContact::partFrom(double pressure, double least_strength) {
  ConformingWayOut way_out;
  const auto rest = restOf(branch_, pressure);
  way_out.has_open_valleys = hasOpenValleys(pressure);
  const double strength =
      way_out.has_open_valleys ? openStrength().traction : std::max(strengthAtWeakestPlace(), least_strength);
  for (auto state = rest; state != branch_.end(); ++state) {
    const double traction = std::min(state->traction, strength);
    way_out.states.push_back({law_->range() - state->height, traction, state->contact_fraction});
    way_out.strength = std::max(way_out.strength, traction);
    if (state->traction > strength) break;
  }
  return way_out;
}

}  // namespace mems_stiction
