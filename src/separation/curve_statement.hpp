#pragma once

/// @file
/// What the separation curve says of its own answer (model_statement.hpp): how far it lies from the half-space, by what
/// flattening costs over what adhesion gives and how brittle contacts are (doc/trust.md).

#include <vector>

#include "mems_stiction/contact/contact_solution.hpp"

namespace mems_stiction {

/// Keeps its memory between calls.
class CurveStatement {
 public:
  static std::vector<UnusedSetting> unusedSettings(const ContactSettings& settings);

  /// - @p solution with its contacts, those at the pull-off too
  /// - @p work_of_adhesion Gamma [J/m^2]
  /// - @p bends whether the bodies bend under the long waves of their relief
  ModelStatement of(const ContactSolution& solution, double work_of_adhesion, bool bends = false);

 private:
  /// Whether the flattening ratio lies below 2 (1 + mu), mu the median Tabor parameter, at most 1: where contacts are
  /// brittle, they grow together over barriers at which the curve rests.
  bool mayGrowTogether(const ContactSolution& solution, double flattening_ratio);

  std::vector<double> values_;
};

}  // namespace mems_stiction
