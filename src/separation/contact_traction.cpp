#include "mems_stiction/separation/contact_traction.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/loads/force_range.hpp"

namespace mems_stiction {
namespace {

/// A layer is not pressed thinner than this share of z0 [-]: hundreds of GPa for any solid.
constexpr double kThinnestLayer = 0.4;
/// The balance of layer and bodies is found to this share of the pressure.
constexpr double kBalance = 1e-6;
constexpr int kMostNewtonSteps = 20;

}  // namespace

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

double ContactTraction::energy(double gap) const {
  const double x = range_ / (gap + range_);
  const double square = x * x;
  return stress_ * range_ * (square / 2.0 - square * square * square * square / 8.0);
}

double ContactTraction::pressureInSeries(double elastic_pressure, double depth) const {
  if (!attracts() || !(elastic_pressure > 0.0)) return std::max(elastic_pressure, 0.0);
  // f(s) = layer(s) - elastic_pressure (1 - s/depth) rises from s = 0, where it is negative, ever more steeply:
  // Newton's steps from the right come down to its zero without passing it, and the first lands on the right.
  const double most = std::min(depth, (1.0 - kThinnestLayer) * range_);
  double s = 0.0;
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const double x = range_ / (range_ - s);
    const double cube = x * x * x;
    const double excess = stress_ * (cube * cube * cube - cube) - elastic_pressure * (1.0 - s / depth);
    const double slope = stress_ / range_ * (9.0 * cube * cube * cube - 3.0 * cube) * x + elastic_pressure / depth;
    const double next = std::clamp(s - excess / slope, 0.0, most);
    const bool is_there = std::abs(next - s) <= kBalance * std::min(depth, range_);
    s = next;
    if (is_there) break;
  }
  return elastic_pressure * (1.0 - s / depth);
}

}  // namespace mems_stiction
