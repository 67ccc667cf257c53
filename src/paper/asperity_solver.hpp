#pragma once

/// @file
/// The paper's solver: every contact patch becomes a couple of spherical caps, JKR applies to each,
/// and the approach ends where the free energy has its extremum (approach_search.hpp).
///
/// Assumptions: asperities act independently; each is a couple of spherical caps; JKR applies to
/// each (the Tabor parameter tells how far it does). Outside: the status says so, forces are then
/// lower bounds. Source: Deladi, Krijnen, Tas, Elwenspoek 2002; doc/theory.md has every equation as
/// implemented.
///
///     AsperitySolver solver(Formulation::kPaper);
///     solver.solve({surfaces, gap, composite_rms_height, settings}, solution);

#include <cstdint>
#include <vector>

#include "approach/gap_order.hpp"
#include "contact/contact_solver.hpp"
#include "paper/approach_search.hpp"

namespace mems_stiction {

/// Knows everything of a ContactSolution but the pressure.
class AsperitySolver : public ContactSolver {
 public:
  explicit AsperitySolver(Formulation formulation) : formulation_(formulation) {}

  void solve(const ContactProblem& problem, ContactSolution& solution) override;

 private:
  /// What one patch does to its cells.
  struct Change {
    double lower_share = 0.0;  ///< of the interference that the lower surface gives way [-]
    double upper_share = 0.0;  ///< of the interference that the upper surface gives way [-]
    std::uint8_t regime = 0;   ///< as in the contact map
  };

  void listAsperities(const ContactProblem& problem, const AsperityLaw& law,
                      ContactSolution& solution) const;
  /// Fills the maps that output asks for, both surfaces after contact and the regime of every cell,
  /// and releases the others.
  void fillMaps(const ContactProblem& problem, const AsperityLaw& law, ContactSolution& solution);

  Formulation formulation_;
  GapOrder order_;
  ApproachSearch search_;
  EquilibriumState state_;
  std::vector<Change> changes_;        ///< in the order of the live patches
  std::vector<double> gaps_;           ///< of one row
  std::vector<std::int32_t> columns_;  ///< of its cells in contact
};

}  // namespace mems_stiction
