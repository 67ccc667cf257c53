#include "mems_stiction/separation/attraction_sum.hpp"

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/base/lanes.hpp"

namespace mems_stiction {

AttractionSum::AttractionSum(const InterfaceOptions& interface, double voltage, double cell_area)
    : law_(interface),
      cell_area_(cell_area),
      field_factor_(0.5 * kVacuumPermittivity * voltage * voltage),
      insulator_(interface.insulator_thickness / interface.insulator_relative_permittivity) {}

MEMS_STICTION_VECTORIZED Attraction AttractionSum::forces(const GapPyramid& gaps, double approach,
                                                          int contact_count) const {
  Attraction sum;
  gaps.visit(
      approach, contact_count, rule(),
      [&](const OrderedCell* cells, std::size_t count) { addForces(cells, count, approach, sum); },
      [&](const GapMoments& bucket) { addForces(bucket, approach, sum); });
  sum.adhesion *= cell_area_;
  sum.electrostatic *= cell_area_ * field_factor_;
  if (field_factor_ > 0.0) sum.electrostatic += contact_count * cell_area_ * field_factor_ / (insulator_ * insulator_);
  return sum;
}

Attraction AttractionSum::all(const GapPyramid& gaps, double approach, int contact_count) const {
  Attraction sum = forces(gaps, approach, contact_count);
  gaps.visit(
      approach, contact_count, rule(),
      [&](const OrderedCell* cells, std::size_t count) { addEnergies(cells, count, approach, sum); },
      [&](const GapMoments& bucket) { addEnergies(bucket, approach, sum); });
  sum.adhesion_energy = cell_area_ * (sum.adhesion_energy + contact_count * law_.workOfAdhesion());
  return sum;
}

MEMS_STICTION_VECTORIZED void AttractionSum::addForces(const OrderedCell* cells, std::size_t count, double approach,
                                                       Attraction& sum) const {
  Lanes adhesion = 0.0;
  Lanes field = 0.0;
  const std::size_t in_lanes = count / Lanes::kCount * Lanes::kCount;
  for (std::size_t i = 0; i < in_lanes; i += Lanes::kCount) {
    const Lanes gap = Lanes(cells[i].gap, cells[i + 1].gap, cells[i + 2].gap, cells[i + 3].gap) - approach;
    adhesion += law_.traction(gap);
    const Lanes distance = gap + insulator_;
    field += 1.0 / (distance * distance);
  }
  sum.adhesion += adhesion.sum();
  if (field_factor_ > 0.0) sum.electrostatic += field.sum();
  for (std::size_t i = in_lanes; i < count; ++i) {
    const double gap = cells[i].gap - approach;
    sum.adhesion += law_.traction(gap);
    if (field_factor_ > 0.0) sum.electrostatic += 1.0 / ((gap + insulator_) * (gap + insulator_));
  }
}

void AttractionSum::addForces(const GapMoments& gaps, double approach, Attraction& sum) const {
  const double gap = gaps.mean - approach;
  sum.adhesion += gaps.count * (law_.traction(gap) + 0.5 * law_.curvature(gap) * gaps.variance);
  if (field_factor_ == 0.0) return;
  const double distance = gap + insulator_;
  const double square = distance * distance;
  sum.electrostatic += gaps.count / square * (1.0 + 3.0 * gaps.variance / square);
}

void AttractionSum::addEnergies(const OrderedCell* cells, std::size_t count, double approach, Attraction& sum) const {
  for (std::size_t i = 0; i < count; ++i) {
    const double gap = cells[i].gap - approach;
    sum.adhesion_energy += law_.energy(gap);
  }
}

void AttractionSum::addEnergies(const GapMoments& gaps, double approach, Attraction& sum) const {
  const double gap = gaps.mean - approach;
  sum.adhesion_energy += gaps.count * law_.energy(gap);
}

}  // namespace mems_stiction
