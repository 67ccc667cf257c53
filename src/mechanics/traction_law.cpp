#include "mechanics/traction_law.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Molar gas constant [J/(mol K)], exact since 2019 (CODATA 2018).
constexpr double kGasConstant = 8.31446261815324;

}  // namespace

AdhesionLaw::AdhesionLaw(double work_of_adhesion, double range)
    : range_(range), stress_(8.0 * work_of_adhesion / (3.0 * range)) {}

double AdhesionLaw::rangeOf(double work_of_adhesion, double hamaker_constant) {
  return std::sqrt(hamaker_constant / (16.0 * kPi * work_of_adhesion));
}

double AdhesionLaw::strength() const {
  return traction(std::sqrt(std::cbrt(1.0 / 3.0)));  // 3 x^4 = 9 x^10
}

FieldLaw::FieldLaw(double voltage, double insulator_thickness,
                   double insulator_relative_permittivity)
    : voltage_(voltage), insulator_(insulator_thickness / insulator_relative_permittivity) {}

WaterLaw::WaterLaw(double relative_humidity, double surface_tension, double contact_angle,
                   double temperature, double molar_volume) {
  if (relative_humidity <= 0.0) return;
  const double undersaturation = -std::log(relative_humidity);
  pressure_ = kGasConstant * temperature * undersaturation / molar_volume;
  kelvin_radius_ = surface_tension / pressure_;
  gap_limit_ = 2.0 * kelvin_radius_ * std::cos(contact_angle);
}

}  // namespace mems_stiction
