#pragma once

/// @file
/// The stopping condition: are the surfaces in equilibrium at this approach?
///
/// The load is shared in proportion to the caps' volumes, F_i = F V_i / sum V (6). Equilibrium is
/// the first state in which the patches can carry F and the generalised force dE_t/dD = sum r_i is
/// no longer positive ("the iteration stops when the incremental free total energy becomes zero").
/// The derivative is used in its closed form, since differences of E_t jump when patches merge.

#include <vector>

#include "paper/asperity_response.hpp"
#include "paper/energies.hpp"

namespace mems_stiction {

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
