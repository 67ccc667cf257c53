#include "mechanics/jkr.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace jkr {

double apparentLoad(double load, double work_of_adhesion, double radius) {
  const double adhesion = 3.0 * kPi * work_of_adhesion * radius;
  // (2P + w') w' with w' = 3 pi w R: at pull-off, P = -w'/2, the first factor is zero without
  // round-off
  return load + adhesion + std::sqrt((2.0 * load + adhesion) * adhesion);
}

double contactRadius(double apparent_load, double radius, double contact_modulus) {
  return apparent_load < 0.0 ? 0.0 : std::cbrt(0.75 * apparent_load * radius / contact_modulus);
}

double apparentLoadOfContact(double contact_radius, double radius, double contact_modulus) {
  return 4.0 / 3.0 * contact_modulus * contact_radius * contact_radius * contact_radius / radius;
}

double equilibriumContactRadius(double load, double work_of_adhesion, double radius,
                                double contact_modulus) {
  return contactRadius(apparentLoad(load, work_of_adhesion, radius), radius, contact_modulus);
}

double energy(double contact_radius, double work_of_adhesion, double radius,
              double contact_modulus) {
  // Load to the Hertzian state of the same contact, then unload at fixed contact by a flat punch of
  // stiffness 2 E a: the stored energy is integral P dd along both, with u the flat punch's part of
  // the approach.
  const double u = std::sqrt(2.0 * kPi * work_of_adhesion * contact_radius / contact_modulus);
  const double punch_stiffness = 2.0 * contact_modulus * contact_radius;
  const double hertz_load = apparentLoadOfContact(contact_radius, radius, contact_modulus);
  const double hertz_approach = contact_radius * contact_radius / radius;
  const double elastic =
      0.4 * hertz_load * hertz_approach - hertz_load * u + 0.5 * punch_stiffness * u * u;
  return elastic - kPi * work_of_adhesion * contact_radius * contact_radius;
}

}  // namespace jkr
}  // namespace mems_stiction
