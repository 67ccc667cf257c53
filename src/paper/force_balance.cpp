#include "paper/force_balance.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

double axialLoad(const AsperityResponse& asperity, const ForceBalance& balance) {
  return balance.load_share * asperity.load_weight * asperity.cos_tilt;
}

}  // namespace

Energies& Energies::operator+=(const Energies& other) {
  mechanical += other.mechanical;
  surface += other.surface;
  elastic += other.elastic;
  return *this;
}

Energies asperityEnergies(const AsperityResponse& asperity, double axial_load,
                          const AsperityLaw& law) {
  const double root = std::cbrt(asperity.imposed_load);
  const double compliance =
      1.0 / (std::cbrt(law.stiffness * law.stiffness) * std::cbrt(asperity.radius));
  Energies energies;
  energies.mechanical =
      compliance * axial_load * (root * root / 3.0 + 2.0 / 3.0 * axial_load / root);
  energies.surface = kPi * law.work_of_adhesion * asperity.cap_radius * asperity.cap_radius;
  energies.elastic =
      compliance * asperity.elastic_share *
      (asperity.imposed_load * root * root / 15.0 + axial_load * axial_load / root / 3.0);
  return energies;
}

ForceBalance forceBalance(const std::vector<AsperityResponse>& responses, double normal_load,
                          const AsperityLaw& law) {
  ForceBalance balance;
  balance.normal_load = normal_load;
  double weight = 0.0;
  for (const AsperityResponse& asperity : responses) {
    weight += asperity.load_weight;
    balance.carried_load += asperity.carriedLoad();
    balance.plastic_force += (1.0 - asperity.elastic_share) * asperity.yield_load;
  }
  balance.load_share = normal_load / weight;
  balance.is_equilibrium =
      balance.carried_load >= normal_load && generalizedForce(responses, balance, law) <= 0.0;
  return balance;
}

double generalizedForce(const std::vector<AsperityResponse>& responses, const ForceBalance& balance,
                        const AsperityLaw& law) {
  double sum = 0.0;
  for (const AsperityResponse& asperity : responses)
    sum += asperity.generalizedForce(axialLoad(asperity, balance), law);
  return sum;
}

Energies totalEnergies(const std::vector<AsperityResponse>& responses, const ForceBalance& balance,
                       const AsperityLaw& law) {
  Energies sum;
  for (const AsperityResponse& asperity : responses)
    sum += asperityEnergies(asperity, axialLoad(asperity, balance), law);
  return sum;
}

}  // namespace mems_stiction
