#include "paper/cell_forces.hpp"

#include "numeric/constants.hpp"
#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

/// The denominator of (2), of one gap or of several; gaps below the cut-off count as the cut-off.
template <typename Real>
MEMS_STICTION_INLINE Real cubedDistance(const Real& gap, double cutoff) {
  const Real distance = select(gap > cutoff, gap, Real(cutoff));
  return distance * distance * distance;
}

}  // namespace

CellForces::CellForces(const InterfaceOptions& interface, double cutoff_distance, double voltage,
                       double cell_area)
    : van_der_waals_factor_(interface.hamaker_constant * cell_area / (6.0 * kPi)),
      cutoff_(cutoff_distance),
      field_(voltage, interface.insulator_thickness, interface.insulator_relative_permittivity),
      electrostatic_factor_(field_.factor(cell_area)) {}

double CellForces::vanDerWaals(double gap) const {
  return van_der_waals_factor_ / cubedDistance(gap, cutoff_);
}

double CellForces::electrostatic(double gap) const {
  if (!hasElectrostatic()) return 0.0;
  return electrostatic_factor_ / field_.squaredDistance(gap);
}

double CellForces::electrostaticInContact() const { return electrostatic(0.0); }

MEMS_STICTION_VECTORIZED void CellForces::addCells(const OrderedCell* cells, std::size_t count,
                                                   double approach, NormalLoad& load) const {
  Packet inverse_cubes = 0.0;
  Packet inverse_squares = 0.0;
  const std::size_t in_fours = visitFours(cells, count, approach, [&](const Packet& gap) {
    inverse_cubes += 1.0 / cubedDistance(gap, cutoff_);
    inverse_squares += 1.0 / field_.squaredDistance(gap);
  });
  load.van_der_waals += van_der_waals_factor_ * inverse_cubes.sum();
  if (hasElectrostatic()) load.electrostatic += electrostatic_factor_ * inverse_squares.sum();
  for (std::size_t i = in_fours; i < count; ++i) {
    load.van_der_waals += vanDerWaals(cells[i].gap - approach);
    load.electrostatic += electrostatic(cells[i].gap - approach);
  }
}

double CellForces::vanDerWaals(const GapMoments& gaps, double approach) const {
  const double gap = gaps.mean - approach;
  if (gap < cutoff_) return gaps.count * vanDerWaals(gap);
  return gaps.count * vanDerWaals(gap) * (1.0 + 6.0 * gaps.variance / (gap * gap));
}

double CellForces::electrostatic(const GapMoments& gaps, double approach) const {
  if (!hasElectrostatic()) return 0.0;
  const double square = field_.squaredDistance(gaps.mean - approach);
  return gaps.count * electrostatic_factor_ / square * (1.0 + 3.0 * gaps.variance / square);
}

MEMS_STICTION_VECTORIZED NormalLoad GapLoads::at(double approach, int contact_count,
                                                 const CellForces& forces,
                                                 double mechanical_load) const {
  NormalLoad load;
  load.mechanical = mechanical_load;
  load.electrostatic = contact_count * forces.electrostaticInContact();
  pyramid_.visit(
      approach, contact_count, {forces.cutoff(), 0.0},
      [&](const OrderedCell* cells, std::size_t count) {
        forces.addCells(cells, count, approach, load);
      },
      [&](const GapMoments& gaps) {
        load.van_der_waals += forces.vanDerWaals(gaps, approach);
        load.electrostatic += forces.electrostatic(gaps, approach);
      });
  return load;
}

}  // namespace mems_stiction
