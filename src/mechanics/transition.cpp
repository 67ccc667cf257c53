#include "mechanics/transition.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {

double taborParameter(double radius, double work_of_adhesion, double contact_modulus,
                      double equilibrium_distance) {
  const double strain = work_of_adhesion / (contact_modulus * equilibrium_distance);
  return std::cbrt(radius / equilibrium_distance * strain * strain);
}

double pullOffPrefactor(double tabor) {
  return maugis::fittedPullOffPrefactor(maugis::transitionParameter(tabor));
}

namespace maugis {

double transitionParameter(double tabor) {
  // 2 (16/(9 sqrt 3)) (9/(16 pi))^(1/3) = 1.1570
  static const double factor = 32.0 / (9.0 * std::sqrt(3.0)) * std::cbrt(9.0 / (16.0 * kPi));
  return factor * tabor;
}

double fittedPullOffPrefactor(double transition_parameter) {
  return fittedPullOffPrefactorOfPower(std::pow(transition_parameter, 1.4));
}

}  // namespace maugis
}  // namespace mems_stiction
