#pragma once

/// @file
/// The two bodies: elastic constants and hardness.

#include <string>

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// One body. Defaults: polysilicon, E and nu by Sharpe et al. 1997 (J. MEMS / MEMS '97); hardness 12 GPa, the middle of
/// the 11-13 GPa of nanoindentation on polysilicon films.
struct Material {
  double youngs_modulus = 169e9;  ///< [Pa], > 0
  double poisson_ratio = 0.22;    ///< [-], in (-1, 0.5]
  double hardness = 12e9;         ///< indentation hardness [Pa], > 0

  void describe(OptionVisitor& visitor, const std::string& prefix);
};

/// What contact mechanics needs of a pair of bodies.
struct ContactPair {
  double contact_modulus;  ///< E of (9): 1/E = (1-nu1^2)/E1 + (1-nu2^2)/E2 [Pa]
  double hardness;         ///< Ha, of the softer body [Pa]

  ContactPair(const Material& lower, const Material& upper);
};

}  // namespace mems_stiction
