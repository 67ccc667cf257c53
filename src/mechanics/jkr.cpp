#include "mechanics/jkr.hpp"

#include <cmath>

#include "mechanics/hertz.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace jkr {

double apparentLoad(double load, double work_of_adhesion, double radius) {
  const double adhesion = 3.0 * kPi * work_of_adhesion * radius;
  // (2P + w') w' with w' = 3 pi w R: at pull-off, P = -w'/2, the first factor is zero without round-off
  return load + adhesion + std::sqrt((2.0 * load + adhesion) * adhesion);
}

double contactRadius(double apparent_load, double radius, double contact_modulus) {
  return hertz::contactRadius(apparent_load, radius, contact_modulus);
}

double apparentLoadOfContact(double contact_radius, double radius, double contact_modulus) {
  return hertz::loadOfContact(contact_radius, radius, contact_modulus);
}

double equilibriumContactRadius(double load, double work_of_adhesion, double radius, double contact_modulus) {
  return contactRadius(apparentLoad(load, work_of_adhesion, radius), radius, contact_modulus);
}

double load(double contact_radius, double work_of_adhesion, double radius, double contact_modulus) {
  const double apparent_load = apparentLoadOfContact(contact_radius, radius, contact_modulus);
  return apparent_load - std::sqrt(6.0 * kPi * work_of_adhesion * radius * apparent_load);
}

double approach(double contact_radius, double work_of_adhesion, double radius, double contact_modulus) {
  return contact_radius * contact_radius / radius -
         std::sqrt(2.0 * kPi * work_of_adhesion * contact_radius / contact_modulus);  // 8/(3K) = 2/E
}

double pullOffForce(double work_of_adhesion, double radius) { return 1.5 * kPi * work_of_adhesion * radius; }

double pullOffContactRadius(double work_of_adhesion, double radius, double contact_modulus) {
  return contactRadius(1.5 * kPi * work_of_adhesion * radius, radius, contact_modulus);
}

double fixedGripsPullOffForce(double work_of_adhesion, double radius) {
  return 5.0 / 6.0 * kPi * work_of_adhesion * radius;
}

double fixedGripsPullOffContactRadius(double work_of_adhesion, double radius, double contact_modulus) {
  return contactRadius(kPi * work_of_adhesion * radius / 6.0, radius, contact_modulus);
}

double energy(double contact_radius, double work_of_adhesion, double radius, double contact_modulus) {
  // Load to the Hertzian state of the same contact, then unload at fixed contact by a flat punch of stiffness 2 E a:
  // the stored energy is integral P dd along both, with u the flat punch's part of the approach.
  const double u = std::sqrt(2.0 * kPi * work_of_adhesion * contact_radius / contact_modulus);
  const double punch_stiffness = 2.0 * contact_modulus * contact_radius;
  const double hertz_load = apparentLoadOfContact(contact_radius, radius, contact_modulus);
  const double hertz_approach = contact_radius * contact_radius / radius;
  const double elastic = 0.4 * hertz_load * hertz_approach - hertz_load * u + 0.5 * punch_stiffness * u * u;
  return elastic - kPi * work_of_adhesion * contact_radius * contact_radius;
}

}  // namespace jkr
}  // namespace mems_stiction
