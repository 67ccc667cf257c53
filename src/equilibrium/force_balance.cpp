#include "mems_stiction/equilibrium/force_balance.hpp"

namespace mems_stiction {

ForceBalance forceBalance(const std::vector<AsperityResponse>& responses, const std::vector<std::int32_t>& patches,
                          double normal_load, const AsperityLaw& law) {
  ForceBalance balance;
  balance.normal_load = normal_load;
  double volume = 0.0;
  for (const std::int32_t id : patches) {
    const AsperityResponse& asperity = responses[static_cast<std::size_t>(id)];
    volume += asperity.volume;
    balance.carried_load += asperity.carriedLoad();
    balance.plastic_force += (1.0 - asperity.elastic_share) * asperity.yield_load;
  }
  balance.load_share = normal_load / volume;
  for (const std::int32_t id : patches) {
    const AsperityResponse& asperity = responses[static_cast<std::size_t>(id)];
    balance.generalized_force +=
        asperity.generalizedForce(balance.load_share * asperity.volume * asperity.cos_tilt, law);
  }
  return balance;
}

Energies totalEnergies(const std::vector<AsperityResponse>& responses, const std::vector<std::int32_t>& patches,
                       const ForceBalance& balance, const AsperityLaw& law) {
  Energies sum;
  for (const std::int32_t id : patches) {
    const AsperityResponse& asperity = responses[static_cast<std::size_t>(id)];
    sum += asperityEnergies(asperity, balance.load_share * asperity.volume * asperity.cos_tilt, law);
  }
  return sum;
}

}  // namespace mems_stiction
