#include "mechanics/hertz.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace hertz {

double contactRadius(double load, double radius, double contact_modulus) {
  return load < 0.0 ? 0.0 : std::cbrt(0.75 * load * radius / contact_modulus);
}

double approach(double load, double radius, double contact_modulus) {
  const double contact_radius = contactRadius(load, radius, contact_modulus);
  return contact_radius * contact_radius / radius;
}

double load(double approach, double radius, double contact_modulus) {
  return approach < 0.0 ? 0.0 : 4.0 / 3.0 * contact_modulus * std::sqrt(radius * approach) * approach;
}

double loadOfContact(double contact_radius, double radius, double contact_modulus) {
  return 4.0 / 3.0 * contact_modulus * contact_radius * contact_radius * contact_radius / radius;
}

double maximumPressure(double load, double radius, double contact_modulus) {
  return 2.0 / kPi * contact_modulus * contactRadius(load, radius, contact_modulus) /
         radius;  // = 3P/(2 pi a^2), also at P = 0
}

double pressure(double distance, double load, double radius, double contact_modulus) {
  const double contact_radius = contactRadius(load, radius, contact_modulus);
  if (!(std::fabs(distance) < contact_radius)) return 0.0;
  const double fraction = distance / contact_radius;
  return maximumPressure(load, radius, contact_modulus) * std::sqrt(1.0 - fraction * fraction);
}

double energy(double approach, double radius, double contact_modulus) {
  return 0.4 * load(approach, radius, contact_modulus) * approach;
}

}  // namespace hertz
}  // namespace mems_stiction
