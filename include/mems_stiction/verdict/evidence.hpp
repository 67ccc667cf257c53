#pragma once

/// @file
/// What else is known of the adhesion of a scan than its prediction: the half-space's answer, and how far the choice of
/// cleaning moves it. A verdict takes both into account (verdict.hpp).
///
///     Evidence evidence;
///     evidence.half_space = &solution;
///     const Verdict verdict = verdictOf(prediction, device, uncertainty, options, cell_area, evidence);

#include <optional>
#include <string>

#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// A figure under the cleanings that count, over the one that is configured [-]: lowest <= 1 <= highest.
struct FactorRange {
  double lowest = 1.0;
  double highest = 1.0;
};

/// How far the choice of cleaning moves a prediction.
struct CleaningReach {
  FactorRange pull_off;
  FactorRange apparent_work;
};

/// Both may be missing.
struct Evidence {
  const SolvedHalfSpace* half_space = nullptr;  ///< of the same scan, settings and load, if it was asked
  std::optional<CleaningReach> cleaning;        ///< if other cleanings were tried
};

/// A half-space that could not be asked.
/// - @p reason why, in a sentence
SolvedHalfSpace unsolvedHalfSpace(const std::string& reason);

/// Why a half-space cannot judge, in words: it is not solved, not converged, its pixels are too large for the edges of
/// the contacts, or its steps for the pull-off force. Empty if it can.
std::string whyNotJudging(const SolvedHalfSpace& solution);

/// The prediction with the half-space's pull-off force and apparent work of adhesion in the place of its own; contacts,
/// exponents and flags stay. It is in equilibrium: what did not end was the formulation's search.
Prediction withHalfSpace(const Prediction& prediction, const SolvedHalfSpace& solution);

/// Standard deviation of the logarithm of the half-space's figures [-]: 2 % for the pixels (on a sphere one per cohesive
/// length is 2.4 % off and two are 0.2 %, doc/verification.md; on rough frames it is not known as well), and what finer
/// steps may add to the pull-off force.
double halfSpaceError(const SolvedHalfSpace& solution);

}  // namespace mems_stiction
