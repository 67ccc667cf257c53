#pragma once

/// @file
/// How well the constants of a prediction are known: what margin_uncertainty.hpp draws its samples
/// from.
///
///     UncertaintyOptions uncertainty;
///     uncertainty.work_of_adhesion = 0.1;  // known within 10 %

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Relative standard uncertainties [-]; 0 = exactly known. Sources of the defaults: polysilicon of
/// Sharpe et al. 1997 (169 +- 6 GPa) and the spread of hardness in use (11 to 13 GPa); the others
/// are usual values: hydrophilic silicon 50 to 150 mJ/m^2, an uncalibrated scanner 2 %, D0 between
/// 0.14 and 0.2 nm; Hamaker constants by Lifshitz' theory from optical spectra to 10 % (Ackler et
/// al. 1996); of contact potentials a third is a guess.
struct UncertaintyOptions {
  double work_of_adhesion = 0.3;   ///< in [0, 1]
  double hardness = 0.08;          ///< in [0, 1]
  double youngs_modulus = 0.04;    ///< in [0, 1]
  double pitch = 0.02;             ///< in [0, 1]
  double cutoff_distance = 0.15;   ///< in [0, 1]
  double hamaker_constant = 0.1;   ///< in [0, 1]
  double contact_potential = 0.3;  ///< in [0, 1]
  bool scan_sampling = true;       ///< the scan is one sample of the surface
  int samples = 200;               ///< in [20, 100000]
  int seed = 1;                    ///< >= 0

  /// Keys uncertainty/...
  void describe(OptionVisitor& visitor);
};

}  // namespace mems_stiction
