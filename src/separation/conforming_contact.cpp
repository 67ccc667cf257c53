#include "separation/conforming_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// Of the strength of the law, Gamma/z0: nearly that of springs, too.
constexpr Exponents kLawExponents{1.5, 0.0, -0.5};

/// k = 2 U/(A sigma^2); bodies without relief have nothing to give way.
double stiffnessOf(double flattening_energy, double rms_height) {
  return flattening_energy > 0.0 && rms_height > 0.0 ? 2.0 * flattening_energy / (rms_height * rms_height)
                                                     : std::numeric_limits<double>::infinity();
}

/// Of a work that is nearly what flattening, which goes with the modulus, leaves of the work of adhesion.
Exponents flatteningExponents(double flattening_energy, double work) {
  const double share = flattening_energy / work;
  return {1.0 + share, -share, 0.0};
}

}  // namespace

void ConformingContact::start(const GapField& field, const ContactTraction& law, double contact_modulus,
                              double flattening_energy) {
  field_ = &field;
  law_ = &law;
  bodies_ = {contact_modulus, law.workOfAdhesion(), law.range(), flattening_energy, field.rmsGap()};
  has_relief_ = false;
  branch_.clear();
}

std::vector<SpringState> ConformingContact::springsOf(double flattening_energy) {
  ReliefClasses depths(0.0, field_->largestGap());
  line_.resize(static_cast<std::size_t>(field_->cols()));
  for (int row = 0; row < field_->rows(); ++row) {
    field_->gapsOfRow(row, line_.data());
    for (const double gap : line_) {
      if (gap <= field_->largestGap()) depths.add(gap);
    }
  }
  return springBranch(depths.classes(), *law_, stiffnessOf(flattening_energy, bodies_.rms_height));
}

const std::vector<SpringState>& ConformingContact::branch() {
  if (branch_.empty()) branch_ = springsOf(bodies_.flattening_energy);
  return branch_;
}

double ConformingContact::work() { return std::max(0.0, -restOf(branch(), 0.0)->energy); }

double ConformingContact::flatteningByWaves() {
  fine_relief_.take(*field_, 0.0);
  fine_waves_.splitHeights(fine_relief_, {field_->cols(), field_->rows()}, bodies_.contact_modulus,
                           std::max(fine_relief_.blockWidth(), fine_relief_.blockHeight()));
  // what is short against the blocks has no direction
  return fine_waves_.energy() + flattening_.of(*field_, fine_waves_.longHeights(), bodies_.contact_modulus);
}

void ConformingContact::takeWork(const WayOut& by_contacts, WayOut& way_out) {
  const double flattening = flatteningByWaves();
  const std::vector<SpringState> springs = springsOf(flattening);
  const double gained = std::max(0.0, -restOf(springs, 0.0)->energy);
  // the surfaces rest in the state of the least energy, and contacts jump in either
  const double work = std::min(gained + by_contacts.lost, bodies_.work_of_adhesion);
  if (by_contacts.work > work) {
    way_out.work = by_contacts.work;
    way_out.work_exponents = by_contacts.work_exponents;
  } else {
    way_out.work = work;
    way_out.work_exponents = flatteningExponents(flattening, work);
  }
}

ReliefSpectrum& ConformingContact::relief() {
  if (!has_relief_) relief_.take(*field_, ReliefWaves::blockLength(bodies_.cohesiveLength()));
  has_relief_ = true;
  return relief_;
}

bool ConformingContact::hasOpenValleys(double pressure) {
  if (!(bodies_.flattening_energy > 0.0 && bodies_.rms_height > 0.0)) return false;
  return valleysStayOpen(relief(), bodies_, pressure);
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

double ConformingContact::strengthOfShortWaves() {
  const double cohesive_length = bodies_.cohesiveLength();
  waves_.split(relief(), {field_->cols(), field_->rows()}, bodies_.contact_modulus, cohesive_length);
  const double cell = std::hypot(field_->pitchX(), field_->pitchY());
  const double short_rms =
      takeShortWaves(waves_.weakestPlace(), std::max(chosen::kTearingZone * cohesive_length, cell));
  const double short_energy = flattening_.of(*field_, waves_.longHeights(), bodies_.contact_modulus);
  if (depths_at_place_.empty()) return law_->strength();  // pixels without a height
  const auto [lowest, highest] = std::minmax_element(depths_at_place_.begin(), depths_at_place_.end());
  ReliefClasses depths(*lowest, *highest);
  for (const double depth : depths_at_place_) depths.add(depth);
  const std::vector<SpringState> branch = springBranch(depths.classes(), *law_, stiffnessOf(short_energy, short_rms));
  return strengthFrom(branch.begin(), branch);
}

WayOut ConformingContact::fromOpenValleys(double pressure) {
  const double brittle = brittleStrength(bodies_);
  const double springs = strengthFrom(restOf(branch(), pressure), branch());
  const double brittle_share = springs / (brittle + springs);
  WayOut way_out = upTo(brittle_share * brittle, pressure);
  way_out.parting = Parting::kFromOpenValleys;
  way_out.doubt = "the surfaces are bonded but for valleys that stay open, and tear from there";
  const double fade = chosen::kDecay * bodies_.flattening_energy / bodies_.work_of_adhesion;
  const double tough_share = 1.0 - brittle_share;
  // of sqrt(Gamma U) exp(-2 U/Gamma) with U in proportion to E, and of the law
  way_out.force_exponents = {brittle_share * (0.5 + fade) + tough_share * kLawExponents.adhesion,
                             brittle_share * (0.5 - fade) + tough_share * kLawExponents.modulus,
                             tough_share * kLawExponents.hamaker};
  return way_out;
}

WayOut ConformingContact::asAWhole(double pressure, double least_force) {
  const double of_place = strengthOfShortWaves();
  const double at_once = of_place - waves_.largestTension();
  double by_contacts = least_force / area();
  if (at_once < by_contacts) {
    by_contacts = strengthAgainstCracks(relief(), bodies_, of_place, by_contacts);
  }
  const double strength = std::max(at_once, by_contacts);
  WayOut way_out = upTo(strength, pressure);
  const bool has_cracks = bodies_.equalRadius(law_->strength()) < bodies_.longestCrack();
  if (has_cracks && way_out.force < chosen::kNearlyWhole * law_->strength() * area()) {
    way_out.doubt = "the surfaces are bonded and part by cracks, which go by details of the relief";
  }
  way_out.parting = Parting::kAsAWhole;
  way_out.force_exponents = kLawExponents;
  return way_out;
}

WayOut ConformingContact::upTo(double strength, double pressure) {
  const auto rest = restOf(branch(), pressure);
  WayOut way_out;
  way_out.work = work();
  way_out.contact_area = rest->contact_fraction * area();
  way_out.work_exponents = flatteningExponents(bodies_.flattening_energy, way_out.work);
  for (auto state = rest; state != branch_.end(); ++state) {
    const double force = area() * std::min(state->traction, strength);
    way_out.curve.push_back({law_->range() - state->height, force, true});
    way_out.force = std::max(way_out.force, force);
    if (state->traction > strength) break;
  }
  return way_out;
}

}  // namespace mems_stiction
