#include "mems_stiction/separation/conforming_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

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

double ConformingContact::weakestPlace(double pressure) {
  waves_.split(relief(), {field_->cols(), field_->rows()}, bodies_.contact_modulus, bondedBodies().cohesiveLength());
  const cv::Mat1d& long_heights = waves_.longHeights();
  const auto visitShort = [&](const auto& visit) {
    for (int row = 0; row < field_->rows(); ++row) {
      field_->gapsOfRow(row, line_.data());
      for (int col = 0; col < field_->cols(); ++col) {
        const double gap = line_[static_cast<std::size_t>(col)];
        if (gap <= field_->largestGap()) visit(gap + long_heights(row, col));
      }
    }
  };
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  visitShort([&](double depth) {
    lowest = std::min(lowest, depth);
    highest = std::max(highest, depth);
  });
  ReliefClasses depths(lowest, highest);
  visitShort([&](double depth) { depths.add(depth); });
  const double short_energy = flattening_.of(*field_, long_heights, bodies_.contact_modulus);
  const std::vector<SpringState> branch =
      springBranch(depths.classes(), *law_, stiffnessOf(short_energy, depths.rms()));
  return strengthFrom(restOf(branch, pressure), branch) - waves_.largestTension();
}

ConformingWayOut ConformingContact::partFrom(double pressure, double least_strength) {
  ConformingWayOut way_out;
  const auto rest = restOf(branch_, pressure);
  way_out.has_open_valleys = hasOpenValleys(pressure);
  const double strength =
      way_out.has_open_valleys ? openStrength().traction : std::max(weakestPlace(pressure), least_strength);
  for (auto state = rest; state != branch_.end(); ++state) {
    const double traction = std::min(state->traction, strength);
    way_out.states.push_back({law_->range() - state->height, traction, state->contact_fraction});
    way_out.strength = std::max(way_out.strength, traction);
    if (state->traction > strength) break;
  }
  return way_out;
}

}  // namespace mems_stiction
