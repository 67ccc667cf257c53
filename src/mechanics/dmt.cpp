#include "mechanics/dmt.hpp"

#include <limits>

#include "mechanics/hertz.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace dmt {

double apparentLoad(double load, double work_of_adhesion, double radius) {
  const double apparent_load = load + pullOffForce(work_of_adhesion, radius);
  return apparent_load < 0.0 ? std::numeric_limits<double>::quiet_NaN() : apparent_load;
}

double equilibriumContactRadius(double load, double work_of_adhesion, double radius, double contact_modulus) {
  return hertz::contactRadius(apparentLoad(load, work_of_adhesion, radius), radius, contact_modulus);
}

double load(double contact_radius, double work_of_adhesion, double radius, double contact_modulus) {
  return hertz::loadOfContact(contact_radius, radius, contact_modulus) - pullOffForce(work_of_adhesion, radius);
}

double approach(double contact_radius, double radius) { return contact_radius * contact_radius / radius; }

double pullOffForce(double work_of_adhesion, double radius) { return 2.0 * kPi * work_of_adhesion * radius; }

}  // namespace dmt
}  // namespace mems_stiction
