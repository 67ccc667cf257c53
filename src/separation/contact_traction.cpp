#include "separation/contact_traction.hpp"

#include "loads/force_range.hpp"

namespace mems_stiction {

ContactTraction::ContactTraction(const InterfaceOptions& interface, const Material& lower,
                                 const Material& upper)
    : work_of_adhesion_(interface.work_of_adhesion), law_(adhesionLaw(interface, lower, upper)) {}

double ContactTraction::strongestGap() const { return law_.strongestGap() - range(); }

double ContactTraction::closingUnder(double pressure) const {
  if (!attracts()) return 0.0;
  // x^9 - x^3 = p/stress rises ever more steeply beyond 1: Newton's steps come down from the right,
  // as in pressureInSeries()
  const double share = pressure / stress();
  double x = std::pow(1.0 + mostOfShare() * share, 1.0 / 9.0);
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const double cube = x * x * x;
    double lacking = cube * (cube * cube - 1.0) - share;
    double slope = 3.0 * cube / x * (3.0 * cube * cube - 1.0);
    if (law_.hasTail()) {
      const auto tail = law_.tail().at(range() / x);
      lacking -= tail.traction / stress();
      slope += tail.slope * range() / (x * x * stress());
    }
    const double next = x - lacking / slope;
    if (!(next < x)) break;
    x = next;
  }
  return range() * (1.0 - 1.0 / x);
}

}  // namespace mems_stiction
