#include "mechanics/surface_forces.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/traction_law.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace surface_forces {

double vanDerWaalsPressure(double gap, double hamaker_constant) {
  return hamaker_constant / (6.0 * kPi * gap * gap * gap);
}

double gapField(double gap, double voltage, double insulator_thickness,
                double insulator_relative_permittivity) {
  return FieldLaw(voltage, insulator_thickness, insulator_relative_permittivity)
      .field(std::max(gap, 0.0));
}

double electrostaticPressure(double gap, double voltage, double insulator_thickness,
                             double insulator_relative_permittivity) {
  if (voltage == 0.0) return 0.0;
  return FieldLaw(voltage, insulator_thickness, insulator_relative_permittivity)
      .pressure(std::max(gap, 0.0));
}

double pullInVoltage(double spring_constant, double rest_gap, double electrode_area,
                     double insulator_thickness, double insulator_relative_permittivity) {
  const double gap = rest_gap + insulator_thickness / insulator_relative_permittivity;
  return std::sqrt(8.0 * spring_constant * gap * gap * gap /
                   (27.0 * kVacuumPermittivity * electrode_area));
}

}  // namespace surface_forces
}  // namespace mems_stiction
