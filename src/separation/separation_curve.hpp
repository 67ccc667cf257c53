#pragma once

/// @file
/// The force between two surfaces at each approach, from the gap alone, and the whole curve of it
/// (doc/separation_curve.md):
///
///     F(D) = B(D) (sum over cells apart t(d) dA - O(D)) + F_e(D) + F_c(D)
///             - sum over patches P_i(D),  d = g - D - b
///
/// D is the displacement of the upper surface past first touch, below zero apart. F > 0 attracts.
/// P_i is what a patch carries, O what contacts have opened of the gap around them (S8b), B what
/// the bodies' bending leaves of the attraction (S7). On the unloading branch soft summits hold
/// until they are drawn out by b (S8a), and flat tops let go from their edges (S8c); on the loading
/// branch neither counts.

#include <vector>

#include "mems_stiction/contact/contact_solution.hpp"
#include "separation/frame_sums.hpp"

namespace mems_stiction {

/// The forces at one approach [N].
struct SeparationState {
  double approach = 0.0;         ///< D [m]
  int contact_count = 0;         ///< cells that overlap
  double adhesion = 0.0;         ///< of the cells apart
  double electrostatic = 0.0;    ///< of all cells
  double lasting_field = 0.0;    ///< of it: of a contact potential alone, when the voltage has gone
  double capillary = 0.0;        ///< of condensed water
  double carried = 0.0;          ///< by all patches
  double tabor_parameter = 0.0;  ///< of the summits in reach [-]
  double hysteresis = 0.0;       ///< b, how far beyond its place apart a summit still holds [m]
  double edge_share =
      1.0;  ///< what the edges of flat tops leave of the attraction's force, (S8c) [-]
  double edge_slope = 0.0;  ///< d ln(edge_share)/d ln E [-]
  double width = 0.0;       ///< a/a0 of the patches in reach, (S8c), their mean by weight [-]
  bool is_in_reach =
      false;  ///< whether any patch is: further apart edges are those of the first state that is

  double force() const { return adhesion + electrostatic + capillary - carried; }
  /// The same when the loads that brought the surfaces together, voltage too, have been taken away:
  /// what bodies give that are drawn apart, whatever the way takes. Its integral is the work.
  double givenForce() const { return adhesion + capillary + lasting_field - carried; }
  /// What it takes to draw them apart: edges let go at less, and over a longer path.
  double partingForce() const {
    return edge_share * adhesion + capillary + lasting_field - carried;
  }
};

/// On which branch the surfaces are, and with what hysteresis.
struct Branch {
  double rest = 0.0;                ///< from which they part [m]
  double largest_hysteresis = 0.0;  ///< what no b exceeds [m]: nothing holds on the loading branch
};

/// From apart to rest.
struct SeparationCurve {
  Branch branch;
  std::vector<SeparationState> states;  ///< by ascending approach; the last one is at rest
  /// Of a loading branch that has found its rest: the next step, pushed back from there.
  SeparationState beyond_rest;
  Status status = Status::kNoEquilibrium;
  double pull_off_force = 0.0;     ///< largest parting force on the way [N]
  double pull_off_approach = 0.0;  ///< where [m]
  std::size_t strongest = 0;       ///< the state next to it
  double elastic_energy =
      0.0;            ///< integral of what the patches carry, from first touch to rest [J]
  double work = 0.0;  ///< integral of the attracting part of the curve, from rest to apart [J]
  double work_apart = 0.0;           ///< what adhesion gives of it before the first state [J]
  double lasting_field_apart = 0.0;  ///< what a contact potential gives there [J]

  const SeparationState& rest() const { return states.back(); }
  /// The first state that pushes the surfaces apart when no load presses them: on the near side of
  /// their rest then. The end of the states where none does.
  std::vector<SeparationState>::const_iterator firstPushing() const;
  /// Bonded, but without the loads the surfaces would have come to rest before.
  bool isBondedByLoad() const {
    return status == Status::kBonded && firstPushing() != states.end();
  }
};

/// The state at one approach.
/// - @p expected_end as in FrameSums::reach()
SeparationState stateAt(FrameSums& frame, double approach, const Branch& branch,
                        double expected_end = 0.0);

/// Follows the curve until the surfaces come to rest under settings.load.mechanical_load: the
/// first approach at which F + F_m falls to 0. Bonded, when they have not until the contact
/// fraction reaches its limit; without equilibrium, when approach/max_steps end first.
void followCurve(FrameSums& frame, const ContactSettings& settings, SeparationCurve& curve);

/// The rest of surfaces none of whose contacts flow, not even as a patch.
SeparationState restIfElastic(const GapField& field, const ContactSettings& settings);

/// The largest parting force on the way from a rest farther on [N]; 0 where there is none, or where
/// what keeps the surfaces from it is more than the error with which the curve knows what the
/// contacts carry.
/// - @p frame whose curve it is, all of whose cells are in its field; its sums stay as they are
double forceFromNextRest(FrameSums& frame, const ContactSettings& settings,
                         const SeparationCurve& loading);

/// Whether the surfaces are drawn past a place at which a little more carried by the contacts would
/// have let them rest, and part with a larger force for it.
/// - @p load that presses them [N]
/// - @p force with which they part [N]
bool isDrawnPastARest(const SeparationCurve& loading, double load, double force);

/// Whether the pull-off force would be larger by more than the error with which the curve knows
/// what the contacts carry if they carried less by that error: on the unloading branch, up to the
/// rest without a load.
bool hangsOnWhatIsCarried(const SeparationCurve& curve);

/// The unloading branch from the rest of a loading branch, with adhesive hysteresis, (S8a).
Branch unloadingOf(const SeparationCurve& loading, double range);
/// Follows the curve outwards: states by ascending approach up to rest.
/// - @p first_touch approach at which the surfaces touch [m]
void followUnloading(FrameSums& frame, double first_touch, const Branch& branch,
                     SeparationCurve& curve);

/// With which powers force and work of a curve go with the constants.
struct CurveExponents {
  Exponents pull_off;
  Exponents work;
};
/// - @p frame whose curve it is
CurveExponents exponentsOf(FrameSums& frame, const SeparationCurve& curve);

}  // namespace mems_stiction
