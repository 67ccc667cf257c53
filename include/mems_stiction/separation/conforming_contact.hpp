#pragma once

/// @file
/// Surfaces that lie against each other everywhere: what it takes to draw them apart.
///
/// Where flattening costs less than adhesion gives, contacts grow together until nothing is left between them, and a sum
/// over patches says little. Each cell then hangs on a spring, all with the same stiffness k per area:
///
///     g = Z + r - u,   k u = t(g),   k = beta 2 U/(A sigma^2)
///
/// r is the relief, sigma its rms height, U/A the energy that flattening takes (flattening.hpp): with beta = 1 the
/// springs store just that when all is flat. A cell stays on its branch while the surfaces are drawn apart, and lets go
/// where -t'(g) = k. What brittle interfaces tear off in one go is shorter than the roughness: the springs are stiffer
/// then, beta = 1 + 1/2/(1 + kappa^2), kappa = k z0^2/Gamma, the one number in this room that is not derived but chosen
/// (1 would be up to 1.5 times too strong there, doc/separation_curve.md).

#include <vector>

#include "mems_stiction/approach/gap_field.hpp"
#include "mems_stiction/separation/contact_traction.hpp"
#include "mems_stiction/separation/separation_trace.hpp"

namespace mems_stiction {

/// One height of the conforming branch, per area.
struct ConformingState {
  double approach = 0.0;          ///< D, z0 less the height of the upper body over first touch [m]
  double traction = 0.0;          ///< [Pa], attraction positive
  double contact_fraction = 0.0;  ///< cells that repel each other [-]
};

/// The whole branch.
struct ConformingContact {
  std::vector<ConformingState> states;  ///< by descending approach, from rest to apart
  double strength = 0.0;                ///< largest traction [Pa]
  double strength_approach = 0.0;       ///< where [m]
  double work = 0.0;                    ///< of drawing them apart from rest [J/m^2]; 0: they do not stay together
};

/// - @p flattening_energy U/A [J/m^2], >= 0
/// - @p pressure with which the surfaces are pressed together at rest [Pa], >= 0
ConformingContact conformingContact(const GapField& field, const ContactTraction& law, double flattening_energy,
                                    double pressure);

}  // namespace mems_stiction
