#include "mems_stiction/separation/contact_traction.hpp"

#include <cmath>

#include "mems_stiction/loads/force_range.hpp"

namespace mems_stiction {
ContactTraction::ContactTraction(const InterfaceOptions& interface)
    : work_of_adhesion_(interface.work_of_adhesion),
      range_(forceRange(interface)),
      stress_(8.0 * work_of_adhesion_ / (3.0 * range_)) {}

double ContactTraction::strength() const {
  const double x_squared = std::cbrt(1.0 / 3.0);  // (z0/(d + z0))^2 where 3 x^4 = 9 x^10
  const double cube = x_squared * std::sqrt(x_squared);
  return stress_ * (cube - cube * cube * cube);
}

double ContactTraction::curvature(double gap) const {
  const double x = range_ / (gap + range_);
  const double fifth = x * x * x * x * x;
  return stress_ / (range_ * range_) * (12.0 * fifth - 90.0 * fifth * fifth * x);
}

}  // namespace mems_stiction
