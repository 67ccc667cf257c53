#pragma once

/// @file
/// What the separation curve says of its own answer (model_statement.hpp): how far it lies from the
/// half-space, by the loading branch which the surfaces part and what that way doubts
/// (doc/trust.md).

#include <vector>

#include "mems_stiction/contact/contact_solution.hpp"

namespace mems_stiction {

/// Of the separation curve.
class CurveStatement {
 public:
  static std::vector<UnusedSetting> unusedSettings(const ContactSettings& settings);

  /// - @p solution whose model already has the doubt of the unloading branch; it is doubted, too,
  /// where bonded surfaces have less energy
  /// - @p gained by flat surfaces that bond, Gamma and what water adds [J/m^2]
  /// - @p are_thin whether the longest wave of the frame meets another stiffness than that of thick
  /// bodies, which the curve follows
  static ModelStatement of(const ContactSolution& solution, double gained, bool are_thin = false);
};

}  // namespace mems_stiction
