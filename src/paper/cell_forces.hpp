#pragma once

/// @file
/// What the cells of a frame that are apart attract each other with: the sums (2) and (3) of the
/// paper.
///
///     F_w = sum H dA/(6 pi max(d, D0)^3)           cells apart                                 (2)
///     F_e = sum eps0 dA U^2/(2 (d + t/eps_r)^2)    cells apart; with d = 0 in contact          (3)
///
/// (2) diverges at the edge of the contact; atoms are finite, so gaps below the cut-off D0 count as
/// D0. (3) is printed with t for t/eps_r: eps_r = 1 is that case.

#include "approach/gap_pyramid.hpp"
#include "mechanics/traction_law.hpp"
#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/loads/interface.hpp"

namespace mems_stiction {

/// The integrands of (2) and (3) for one cell.
class CellForces {
 public:
  /// - @p cutoff_distance D0 [m], > 0
  CellForces(const InterfaceOptions& interface, double cutoff_distance, double voltage,
             double cell_area);

  double vanDerWaals(double gap) const;    ///< of a cell apart by gap [m]: [N]
  double electrostatic(double gap) const;  ///< of a cell apart by gap [m]: [N]
  double electrostaticInContact() const;   ///< of a cell in contact [N]
  /// Adds both of many cells that are apart by their gap - approach [m].
  void addCells(const OrderedCell* cells, std::size_t count, double approach,
                NormalLoad& load) const;
  double cutoff() const { return cutoff_; }  ///< D0 [m]
  bool hasElectrostatic() const { return field_.isOn(); }

  /// Sum over many cells from count, mean and variance of their gaps about the approach: Taylor to
  /// second order, good where the spread is small against the gap.
  double vanDerWaals(const GapMoments& gaps, double approach) const;
  double electrostatic(const GapMoments& gaps, double approach) const;

 private:
  double van_der_waals_factor_;
  double cutoff_;
  FieldLaw field_;
  double electrostatic_factor_;
};

/// Both sums at any approach, without a pass over the frame (gap_pyramid.hpp). Agrees with the sum
/// over cells to 1e-3 relative (tested).
class GapLoads {
 public:
  /// Prepares the sums for a frame; keeps a reference to the order. Memory is reused.
  void prepare(const GapOrder& order) { pyramid_.prepare(order); }

  /// Loads when the first `contact_count` ordered cells are in contact and the others are apart by
  /// gap - approach.
  NormalLoad at(double approach, int contact_count, const CellForces& forces,
                double mechanical_load) const;

 private:
  GapPyramid pyramid_;
};

}  // namespace mems_stiction
