#include "paper/energies.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {

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

}  // namespace mems_stiction
