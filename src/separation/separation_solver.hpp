#pragma once

/// @file
/// The solver of the separation curve: the force between the surfaces at each displacement,
/// adhesion counted once.
///
/// Rest is where the curve carries the mechanical load. The pull-off force is its largest value on
/// the unloading branch, the apparent work of adhesion its area, both when the loads that made the
/// contact, voltage too, have been taken away. Soft summits let go later than they would touch on
/// the loading branch; surfaces that have flowed come apart along the curve of the changed
/// surfaces, and bonded ones, whose flattening costs less than adhesion gives, along that of
/// springs (conforming_contact.hpp). Equations, derivation, limits: doc/separation_curve.md.
///
/// Forces (1.5 pi Gamma R) and areas of asperities by JKR are NaN; contacts have what the patches
/// have: real area, radius, load, regime by flow, Tabor's parameter, but no tilt.
///
///     SeparationSolver solver;
///     solver.solve({surfaces, gap, composite_rms_height, settings}, solution);

#include <cstdint>
#include <optional>
#include <vector>

#include "contact/contact_solver.hpp"
#include "separation/closing_places.hpp"
#include "separation/conforming_contact.hpp"
#include "separation/contact_curve.hpp"
#include "separation/curve_statement.hpp"
#include "separation/flat_tops.hpp"
#include "separation/flattening.hpp"
#include "separation/flowing_places.hpp"
#include "separation/plate_tilt.hpp"
#include "separation/unloading.hpp"

namespace mems_stiction {

/// Knows everything of a ContactSolution but the sums by JKR and the pressure.
class SeparationSolver : public ContactSolver {
 public:
  void solve(const ContactProblem& problem, ContactSolution& solution) override;

 private:
  /// All that a solution says of the surfaces at rest.
  /// @return the gap at rest, as flow leaves it
  const GapField& comeToRest(const ContactProblem& problem, ContactSolution& solution);
  /// Whether places flow under the loads at rest; if so the curve is that of the changed surfaces
  /// from then on.
  bool flow(const ContactProblem& problem);
  void takeRest(const ContactProblem& problem, ContactSolution& solution);
  void findBorder(const GapField& field);
  /// Calls take(row, column, overlap [m], place of the contact) for each cell that overlaps at
  /// rest, row by row.
  template <typename Taker>
  void visitOverlaps(const GapField& field, const Taker& take);
  void listContacts(const ContactProblem& problem, ContactSolution& solution);
  /// The deepest cells of a contact touch, as many as the real area has: those of a paraboloid
  /// whose overlap exceeds this [m].
  void takeLeastOverlaps(const GapField& field);
  void fillMaps(const ContactProblem& problem, ContactSolution& solution);
  /// The unloading branch of surfaces that are bonded at rest; none if they part by contacts.
  std::optional<Unloading> bondedUnloading(const ContactProblem& problem, double joined_share,
                                           const ContactSolution& solution);
  /// Which way the surfaces part, of two that have come to rest.
  void takeDecision(bool is_conforming, ContactSolution& solution) const;
  void takeUnloading(const Unloading& unloading, ContactSolution& solution) const;
  /// The doubts of bonded surfaces of changing texture, of blocks that close by themselves and of
  /// flat tops, where there is no other.
  void doubtPlaces(const GapField& field, ContactSolution& solution);
  /// Whether contacts with flat tops hold more than this together [N], and than one by one.
  bool holdTogether(double force);
  /// The doubt of contacts that have flowed, where there is no other.
  void doubtFlow(ContactSolution& solution) const;
  /// The contacts that hold at the pull-off: patches within reach of the attraction there.
  void listPullOffContacts(const ContactProblem& problem, ContactSolution& solution);

  PlateTilt tilt_;
  ContactCurve curve_;
  FlowingPlaces places_that_flow_;
  FlatTops flat_tops_;
  bool has_flowed_ = false;  ///< place by place
  /// By flow, so much more than without that how far they flow is not sure.
  bool attracts_more_ = false;
  bool is_overloaded_ = false;              ///< by more than the contacts of the curve carry
  std::vector<std::uint8_t> is_at_border_;  ///< of the contacts at rest
  std::vector<std::uint8_t> overlaps_;      ///< by cell
  std::vector<double> least_overlaps_;      ///< of the contacts at rest [m]
  std::vector<double> flowed_line_;
  std::vector<double> pressure_line_;
  FlatteningEnergy flattening_;
  ConformingContact conforming_;
  ClosingPlaces places_;
};

}  // namespace mems_stiction
