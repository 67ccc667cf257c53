#include "mems_stiction/mechanics/traction_law.hpp"

#include <cmath>

#include "mems_stiction/base/constants.hpp"

namespace mems_stiction {

AdhesionLaw::AdhesionLaw(double work_of_adhesion, double range)
    : range_(range), stress_(8.0 * work_of_adhesion / (3.0 * range)) {}

double AdhesionLaw::rangeOf(double work_of_adhesion, double hamaker_constant) {
  return std::sqrt(hamaker_constant / (16.0 * kPi * work_of_adhesion));
}

double AdhesionLaw::strength() const {
  return traction(std::sqrt(std::cbrt(1.0 / 3.0)));  // 3 x^4 = 9 x^10
}

FieldLaw::FieldLaw(double voltage, double insulator_thickness, double insulator_relative_permittivity)
    : voltage_(voltage), insulator_(insulator_thickness / insulator_relative_permittivity) {}

}  // namespace mems_stiction
