#include "separation/conforming_contact.hpp"

#include <algorithm>
#include <limits>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// Of the strength of the law, Gamma/z0: nearly that of springs, too.
/// - @p field_share of the force that is a field's
/// - @p water_share that is water's, on which none of the constants acts
Exponents lawExponents(double field_share, double water_share) {
  const double rest = 1.0 - field_share - water_share;
  return {1.5 * rest, 0.0, -0.5 * rest, 2.0 * field_share};
}

/// k = 2 U/(A sigma^2); bodies without relief have nothing to give way.
double stiffnessOf(double flattening_energy, double rms_height) {
  return flattening_energy > 0.0 && rms_height > 0.0
             ? 2.0 * flattening_energy / (rms_height * rms_height)
             : std::numeric_limits<double>::infinity();
}

/// Of a work that is nearly what flattening, which goes with the modulus, leaves of the work of
/// adhesion.
/// - @p field_energy what a field gives of it
/// - @p water_energy what water gives
Exponents flatteningExponents(double flattening_energy, double field_energy, double water_energy,
                              double work) {
  const double share = flattening_energy / work;
  const double field_share = field_energy / work;
  return {1.0 + share - field_share - water_energy / work, -share, 0.0, 2.0 * field_share};
}

}  // namespace

void ConformingContact::start(const GapField& gap, const ContactTraction& law,
                              const FieldLaw& field, const WaterLaw& water, double contact_modulus,
                              double flattening_energy) {
  gap_ = &gap;
  field_ = field;
  water_ = water;
  law_ = &law;
  contact_modulus_ = contact_modulus;
  flattening_energy_ = flattening_energy;
  relief_.clear();
  branch_.clear();
}

const std::vector<ReliefClass>& ConformingContact::relief() {
  if (!relief_.empty()) return relief_;
  ReliefClasses depths(0.0, gap_->largestGap());
  line_.resize(static_cast<std::size_t>(gap_->cols()));
  for (int row = 0; row < gap_->rows(); ++row) {
    gap_->gapsOfRow(row, line_.data());
    for (const double gap : line_) {
      if (gap <= gap_->largestGap()) depths.add(gap);
    }
  }
  return relief_ = depths.classes();
}

std::vector<SpringState> ConformingContact::springsOf(double flattening_energy) {
  return springBranch(relief(), *law_, field_, water_,
                      stiffnessOf(flattening_energy, gap_->rmsGap()));
}

const std::vector<SpringState>& ConformingContact::branch() {
  if (branch_.empty()) branch_ = springsOf(flattening_energy_);
  return branch_;
}

bool ConformingContact::holds() {
  const std::vector<SpringState>& springs = branch();
  // where all springs have let go the field still pulls
  const double apart = field_.isOn() ? field_.energy(springs.back().height - law_->range()) : 0.0;
  return energyGained(springs) > apart;
}

double ConformingContact::energyGained(const std::vector<SpringState>& springs) {
  return std::max(0.0, -restOf(springs, 0.0)->energy);
}

Unloading ConformingContact::unloading(const Unloading& by_contacts, double pressure) {
  const auto rest = restOf(branch(), pressure);
  Unloading unloading;
  unloading.contact_area =
      repellingShare(rest, branch_, pressure, relief(), law_->range()) * area();
  unloading.force = area() * strengthFrom(rest, branch_);
  const double strongest = law_->strongestGap();
  unloading.force_exponents =
      lawExponents(field_.isOn() ? area() * field_.pressure(strongest) / unloading.force : 0.0,
                   std::min(1.0, area() * water_.pressure(strongest) / unloading.force));
  const double by_waves = waves_.of(*gap_, contact_modulus_);
  if (mayTear(flattening_energy_) || mayTear(by_waves))
    unloading.doubt = "the surfaces are bonded, and long waves of their relief may tear them apart";
  for (auto state = rest; state != branch_.cend(); ++state) {
    unloading.curve.push_back({law_->range() - state->height, area() * state->traction, true});
  }
  takeWork(by_contacts, by_waves, unloading);
  return unloading;
}

bool ConformingContact::mayTear(double flattening_energy) const {
  const double rms_height = gap_->rmsGap();
  if (!(flattening_energy > 0.0 && rms_height > 0.0)) return false;
  const double wave_number = 4.0 * flattening_energy / (contact_modulus_ * rms_height * rms_height);
  const double tension = 2.0 * flattening_energy / rms_height;
  const auto mayTearUnder = [&](double work, double strength) {
    const double crack_radius = 0.5 * kPi * contact_modulus_ * work / (strength * strength);
    return kPi / wave_number > crack_radius && tension > chosen::kHardlyTense * strength;
  };
  // water that has left the crack holds it no more
  return mayTearUnder(law_->workOfAdhesion(), law_->strength()) ||
         mayTearUnder(law_->workOfAdhesion() + water_.energy(0.0),
                      law_->strength() + water_.pressure(law_->strongestGap()));
}

// (S10a)
void ConformingContact::takeWork(const Unloading& by_contacts, double flattening,
                                 Unloading& unloading) {
  const double by_field = field_.isOn() ? field_.energy(0.0) : 0.0;
  const double by_water = water_.energy(0.0);
  // the surfaces rest in the state of the least energy, and contacts jump in either
  const double work = std::min(energyGained(springsOf(flattening)) + by_contacts.lost,
                               law_->workOfAdhesion() + by_field + by_water);
  if (by_contacts.work > work) {
    unloading.work = by_contacts.work;
    unloading.work_exponents = by_contacts.work_exponents;
  } else {
    unloading.work = work;
    unloading.work_exponents = flatteningExponents(flattening, by_field, by_water, work);
  }
}

}  // namespace mems_stiction
