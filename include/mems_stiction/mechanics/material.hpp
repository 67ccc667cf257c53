#pragma once

/// @file
/// The two bodies: elastic constants, hardness, what is behind their surfaces, and of what the
/// outermost nanometres are.
///
///     Material gold;
///     gold.youngs_modulus = 78e9;  // [Pa]
///     gold.poisson_ratio = 0.44;
///     gold.hardness = 1e9;  // [Pa]
///     print(ContactPair(gold, gold).contact_modulus);

#include <string>
#include <vector>

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// What holds a body of finite thickness: nothing, as a beam or plate in the air, or all of its
/// lower side.
enum class Backing { kFree, kBonded };

/// What a film is bonded to; thick.
struct Substrate {
  double youngs_modulus = 0.0;  ///< [Pa], >= 0; 0 = rigid
  double poisson_ratio = 0.22;  ///< [-], in (-1, 0.5]; not looked at where it is rigid
};

/// One body. Defaults: polysilicon, E and nu by Sharpe et al. 1997 (J. MEMS / MEMS '97); hardness
/// 12 GPa, the middle of the 11-13 GPa of nanoindentation on polysilicon films.
struct Material {
  double youngs_modulus = 169e9;  ///< [Pa], > 0
  double poisson_ratio = 0.22;    ///< [-], in (-1, 0.5]
  double hardness = 12e9;         ///< indentation hardness [Pa], > 0
  double thickness = 0.0;         ///< [m], >= 0; 0 = thick against every wave of its surface
  Backing backing = Backing::kFree;
  Substrate substrate;            ///< of a bonded film
  double film_thickness = 0.0;    ///< of a native film, which attracts by
                                  ///< interface/hamaker_constant [m], >= 0; 0 = none
  double hamaker_constant = 0.0;  ///< of what is under the film [J], >= 0; 0 = as the film

  void describe(OptionVisitor& visitor, const std::string& prefix);
  /// Settings that do not go together, one line each; empty when all is well. Ranges are not looked
  /// at.
  std::vector<std::string> contradictions(const std::string& prefix) const;
};

/// What contact mechanics needs of a pair of bodies.
struct ContactPair {
  double contact_modulus;  ///< E of (9): 1/E = (1-nu1^2)/E1 + (1-nu2^2)/E2 [Pa]
  double hardness;         ///< Ha, of the softer body [Pa]

  ContactPair(const Material& lower, const Material& upper);
};

}  // namespace mems_stiction
