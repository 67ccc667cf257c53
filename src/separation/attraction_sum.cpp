#include "mems_stiction/separation/attraction_sum.hpp"

#include "mems_stiction/base/lanes.hpp"

namespace mems_stiction {

AttractionSum::AttractionSum(const InterfaceOptions& interface, double voltage, double cell_area)
    : law_(interface),
      cell_area_(cell_area),
      field_(voltage, interface.insulator_thickness, interface.insulator_relative_permittivity) {}

MEMS_STICTION_VECTORIZED Attraction AttractionSum::forces(const GapPyramid& gaps, double approach,
                                                          int contact_count) const {
  Attraction sum;
  gaps.visit(
      approach, contact_count, rule(),
      [&](const OrderedCell* cells, std::size_t count) { addForces(cells, count, approach, sum); },
      [&](const GapMoments& bucket) { addForces(bucket, approach, sum); });
  sum.adhesion *= cell_area_;
  sum.electrostatic *= cell_area_ * field_.factor();
  if (field_.isOn()) sum.electrostatic += contact_count * cell_area_ * field_.pressure(0.0);
  return sum;
}

double AttractionSum::energy(const GapPyramid& gaps, double approach, int contact_count) const {
  double sum = 0.0;
  gaps.visit(
      approach, contact_count, rule(),
      [&](const OrderedCell* cells, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) sum += law_.energy(cells[i].gap - approach);
      },
      [&](const GapMoments& bucket) { sum += bucket.count * law_.energy(bucket.mean - approach); });
  return cell_area_ * (sum + contact_count * law_.workOfAdhesion());
}

MEMS_STICTION_VECTORIZED void AttractionSum::addForces(const OrderedCell* cells, std::size_t count, double approach,
                                                       Attraction& sum) const {
  Lanes adhesion = 0.0;
  Lanes field = 0.0;
  const std::size_t in_lanes = count / Lanes::kCount * Lanes::kCount;
  for (std::size_t i = 0; i < in_lanes; i += Lanes::kCount) {
    const Lanes gap = Lanes(cells[i].gap, cells[i + 1].gap, cells[i + 2].gap, cells[i + 3].gap) - approach;
    adhesion += law_.traction(gap);
    field += 1.0 / field_.squaredDistance(gap);
  }
  sum.adhesion += adhesion.sum();
  if (field_.isOn()) sum.electrostatic += field.sum();
  for (std::size_t i = in_lanes; i < count; ++i) {
    const double gap = cells[i].gap - approach;
    sum.adhesion += law_.traction(gap);
    if (field_.isOn()) sum.electrostatic += 1.0 / field_.squaredDistance(gap);
  }
}

void AttractionSum::addForces(const GapMoments& gaps, double approach, Attraction& sum) const {
  const double gap = gaps.mean - approach;
  sum.adhesion += gaps.count * (law_.traction(gap) + 0.5 * law_.curvature(gap) * gaps.variance);
  if (!field_.isOn()) return;
  const double square = field_.squaredDistance(gap);
  sum.electrostatic += gaps.count / square * (1.0 + 3.0 * gaps.variance / square);
}

}  // namespace mems_stiction
