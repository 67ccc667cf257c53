#include "separation/contact_traction.hpp"

#include "loads/force_range.hpp"

namespace mems_stiction {

ContactTraction::ContactTraction(const InterfaceOptions& interface)
    : work_of_adhesion_(interface.work_of_adhesion),
      law_(work_of_adhesion_, forceRange(interface)) {}

double ContactTraction::closingUnder(double pressure) const {
  if (!attracts()) return 0.0;
  // x^9 - x^3 = p/stress rises ever more steeply beyond 1: Newton's steps come down from the right,
  // as in pressureInSeries()
  const double share = pressure / stress();
  double x = std::pow(1.0 + 1.5 * share, 1.0 / 9.0);
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const double cube = x * x * x;
    const double next =
        x - (cube * (cube * cube - 1.0) - share) / (3.0 * cube / x * (3.0 * cube * cube - 1.0));
    if (!(next < x)) break;
    x = next;
  }
  return range() * (1.0 - 1.0 / x);
}

}  // namespace mems_stiction
