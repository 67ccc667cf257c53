#include "mechanics/traction_law.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Molar gas constant [J/(mol K)], exact since 2019 (CODATA 2018).
constexpr double kGasConstant = 8.31446261815324;

/// Where something that is above 0 at `narrow` and below 0 at `wide` changes its sign, to the last
/// bit.
template <typename Function>
double signChange(double narrow, double wide, const Function& function) {
  while (true) {
    const double middle = 0.5 * (narrow + wide);
    if (middle <= narrow || middle >= wide) return middle;
    (function(middle) > 0.0 ? narrow : wide) = middle;
  }
}

/// Work of separation from a gap at which the attraction is balanced by a repulsion that falls as
/// its ninth power [J/m^2].
double workFrom(double gap, const LayeredAttraction& attraction) {
  const LayeredAttraction::Point<double> point = attraction.at(gap);
  return point.energy - 0.125 * gap * point.traction;
}

}  // namespace

AdhesionLaw::AdhesionLaw(double work_of_adhesion, double range)
    : range_(range),
      stress_(8.0 * work_of_adhesion / (3.0 * range)),
      strength_(traction(std::sqrt(std::cbrt(1.0 / 3.0)))),  // 3 x^4 = 9 x^10
      strongest_gap_(std::pow(3.0, 1.0 / 6.0) * range) {}

AdhesionLaw::AdhesionLaw(double work_of_adhesion, double range, const LayeredAttraction& attraction)
    : AdhesionLaw(work_of_adhesion, range) {
  if (attraction.isPlain() || !(work_of_adhesion > 0.0)) return;
  const LayeredAttraction whole = attraction.times(work_of_adhesion / workFrom(range, attraction));
  stress_ = whole.at(range).traction;  // so that the tail has no traction at z0
  tail_ = whole.less(stress_ * range * range * range);
  has_tail_ = true;
  // the attraction's slope falls less fast than g^-10, the repulsion's: one sign change
  strongest_gap_ = signChange(
      range, 2.0 * range, [&](double gap) { return slope(range_ / gap) + tail_.at(gap).slope; });
  strength_ = traction(range_ / strongest_gap_) + tail_.at(strongest_gap_).traction;
}

double AdhesionLaw::rangeOf(double work_of_adhesion, double hamaker_constant) {
  return std::sqrt(hamaker_constant / (16.0 * kPi * work_of_adhesion));
}

double AdhesionLaw::rangeOf(double work_of_adhesion, const LayeredAttraction& attraction) {
  double range = rangeOf(work_of_adhesion, attraction.filmConstant());
  if (attraction.isPlain()) return range;
  // the work falls with the gap, as no attraction falls so fast as g^-9
  const auto excess = [&](double gap) { return workFrom(gap, attraction) - work_of_adhesion; };
  double wide = range;
  while (excess(range) < 0.0) range *= 0.5;
  while (excess(wide) > 0.0) wide *= 2.0;
  return signChange(range, wide, excess);
}

FieldLaw::FieldLaw(double voltage, double insulator_thickness,
                   double insulator_relative_permittivity)
    : voltage_(voltage), insulator_(insulator_thickness / insulator_relative_permittivity) {}

WaterLaw::WaterLaw(double relative_humidity, double surface_tension, double contact_angle,
                   double temperature, double molar_volume, double film) {
  if (relative_humidity <= 0.0) return;
  const double undersaturation = -std::log(relative_humidity);
  pressure_ = kGasConstant * temperature * undersaturation / molar_volume;
  kelvin_radius_ = surface_tension / pressure_;
  gap_limit_ = 2.0 * kelvin_radius_ * std::cos(contact_angle) + 2.0 * film;
}

}  // namespace mems_stiction
