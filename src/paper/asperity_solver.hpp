#pragma once

/// @file
/// The paper's solver: every contact patch becomes a couple of spherical caps, JKR applies to each, and the approach
/// ends where the free energy has its extremum (approach_search.hpp).
///
/// Assumptions: asperities act independently; each is a couple of spherical caps; JKR applies to each (the Tabor
/// parameter tells how far it does). Outside: the status says so, forces are then lower bounds.
/// Source: Deladi, Krijnen, Tas, Elwenspoek 2002; doc/theory.md has every equation as implemented.
///
///     AsperitySolver solver(Formulation::kPaper);
///     solver.solve({surfaces, gap, composite_rms_height, settings}, solution);

#include "approach/gap_order.hpp"
#include "contact/contact_solver.hpp"
#include "paper/approach_search.hpp"
#include "paper/contact_maps.hpp"

namespace mems_stiction {

/// Knows everything of a ContactSolution but the pressure.
class AsperitySolver : public ContactSolver {
 public:
  explicit AsperitySolver(Formulation formulation) : formulation_(formulation) {}

  void solve(const ContactProblem& problem, ContactSolution& solution) override;

 private:
  void listAsperities(const ContactProblem& problem, const AsperityLaw& law, ContactSolution& solution) const;

  Formulation formulation_;
  GapOrder order_;
  ApproachSearch search_;
  EquilibriumState state_;
  ContactMaps maps_;
};

}  // namespace mems_stiction
