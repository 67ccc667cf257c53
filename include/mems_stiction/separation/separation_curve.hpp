#pragma once

/// @file
/// The whole curve of one frame: from apart to rest, with its largest force and its work.

#include <vector>

#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/separation/separation_trace.hpp"

namespace mems_stiction {

/// From apart to rest.
struct SeparationCurve {
  std::vector<SeparationState> states;  ///< by ascending approach; the last one is at rest
  Status status = Status::kNoEquilibrium;
  double pull_off_force = 0.0;     ///< largest parting force on the way [N]
  double pull_off_approach = 0.0;  ///< where [m]
  std::size_t strongest = 0;       ///< the state next to it
  double elastic_energy = 0.0;     ///< integral of what the patches carry, from first touch to rest [J]
  double work = 0.0;               ///< integral of the attracting part of the curve, from rest to apart [J]
  double work_apart = 0.0;         ///< what of it lies before the first state [J]

  const SeparationState& rest() const { return states.back(); }
  /// The first state that pushes the surfaces apart when no load presses them: on the near side of their rest then. The end
  /// of the states where none does.
  std::vector<SeparationState>::const_iterator firstPushing() const;
};

/// Largest rise of the parting force after it has fallen, to either side of its maximum, as far as the first state that
/// pushes; of the maximum [-]. It tells of contacts that join one after another.
double joiningRise(const SeparationCurve& curve);

/// Follows the curve until the surfaces come to rest under settings.load.mechanical_load: the largest approach at which
/// F + F_m >= 0. Bonded, when they have not until the contact fraction reaches its limit; without equilibrium, when
/// approach/max_steps end first. The trace stands at rest then.
void followCurve(SeparationTrace& trace, const ContactSettings& settings, SeparationCurve& curve);

/// The same from a given approach outwards, of surfaces that have flowed: states by ascending approach up to `rest` [m].
/// - @p first_touch approach at which they touch [m]
void followCurveUpTo(SeparationTrace& trace, double first_touch, double rest, SeparationCurve& curve);

/// With which powers force and work of a curve go with the constants.
struct CurveExponents {
  Exponents pull_off;
  Exponents work;
};
/// - @p trace that has followed it last
CurveExponents exponentsOf(SeparationTrace& trace, const SeparationCurve& curve);

}  // namespace mems_stiction
