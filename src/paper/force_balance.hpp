#pragma once

/// @file
/// The stopping condition: are the surfaces in equilibrium at this approach?
///
/// The load is shared in proportion to the caps' volumes, F_i = F V_i / sum V (6). Equilibrium is
/// the first state in which the patches can carry F and the generalised force dE_t/dD = sum r_i is
/// no longer positive ("the iteration stops when the incremental free total energy becomes zero").
/// The derivative is used in its closed form, since differences of E_t jump when patches merge.
///
/// The energies along the approach are (8) and (10) with JKR's exponents, which the print lost.
///
///     p   = 1/(K^(2/3) R^(1/3))
///     E_m = sum p P0 [ P1^(2/3)/3 + (2/3) P0 P1^(-1/3) ]               (10.1)
///     E_s = pi Gamma sum rc^2                                          (10.1)
///     E_e = sum p chi [ P1^(5/3)/15 + P0^2 P1^(-1/3)/3 ]               (10.2)
///     E_t = E_m + E_s - E_e                                            (8)
///
/// E_t is minus JKR's total energy: equilibrium is a maximum of E_t.
/// Source: Johnson, Kendall and Roberts 1971 for the exponents; equations of Deladi et al. 2002.

#include <vector>

#include "paper/asperity_response.hpp"

namespace mems_stiction {

/// The terms of (8), summed over the asperities [J].
struct Energies {
  double mechanical = 0.0;  ///< E_m [J]
  double surface = 0.0;     ///< E_s [J]
  double elastic = 0.0;     ///< E_e [J]

  double total() const { return mechanical + surface - elastic; }
  Energies& operator+=(const Energies& other);
};

/// Energies of one asperity under the axial load P0 [N].
Energies asperityEnergies(const AsperityResponse& asperity, double axial_load,
                          const AsperityLaw& law);

/// What presses, what carries, and what is left.
struct ForceBalance {
  double normal_load = 0.0;   ///< F [N]
  double load_share = 0.0;    ///< F / sum V: F_i = load_share V_i
  double carried_load = 0.0;  ///< what the patches can carry [N]
  double plastic_force =
      0.0;  ///< sum (1 - chi) Ha pi rc^2, the work dissipated per unit of approach [N]
  bool is_equilibrium = false;
};

/// - @p responses of all patches; sums run in this order
ForceBalance forceBalance(const std::vector<AsperityResponse>& responses, double normal_load,
                          const AsperityLaw& law);

/// dE_t/dD = sum r_i under the balance's loads [N].
double generalizedForce(const std::vector<AsperityResponse>& responses, const ForceBalance& balance,
                        const AsperityLaw& law);

/// Energies of all patches under the balance's loads.
Energies totalEnergies(const std::vector<AsperityResponse>& responses, const ForceBalance& balance,
                       const AsperityLaw& law);

}  // namespace mems_stiction
