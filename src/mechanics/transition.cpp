#include "mechanics/transition.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// s + (s^2 - 1) atan(s), the bracket of Maugis' first term; its leading terms cancel for small s.
double firstBracket(double s) {
  if (s > 0.05) return s + (s * s - 1.0) * std::atan(s);
  const double q = s * s;
  return s * q * (4.0 / 3.0 - q * (8.0 / 15.0 - q * (12.0 / 35.0 - q * (16.0 / 63.0 - q * 20.0 / 99.0))));
}

/// s atan(s) - m + 1 with m = sqrt(1 + s^2), the bracket of his second term.
double secondBracket(double s) { return s * std::atan(s) - s * s / (1.0 + std::sqrt(1.0 + s * s)); }

}  // namespace

double taborParameter(double radius, double work_of_adhesion, double contact_modulus, double equilibrium_distance) {
  const double strain = work_of_adhesion / (contact_modulus * equilibrium_distance);
  return std::cbrt(radius / equilibrium_distance * strain * strain);
}

double pullOffPrefactor(double tabor) { return maugis::fittedPullOffPrefactor(maugis::transitionParameter(tabor)); }

namespace maugis {

double transitionParameter(double tabor) {
  // 2 (16/(9 sqrt 3)) (9/(16 pi))^(1/3) = 1.1570
  static const double factor = 32.0 / (9.0 * std::sqrt(3.0)) * std::cbrt(9.0 / (16.0 * kPi));
  return factor * tabor;
}

double transitionParameter(double adhesive_stress, double radius, double work_of_adhesion, double contact_modulus) {
  const double k = 4.0 / 3.0 * contact_modulus;
  return 2.0 * adhesive_stress * std::cbrt(radius / (kPi * work_of_adhesion * k * k));
}

double fittedPullOffPrefactor(double transition_parameter) {
  return fittedPullOffPrefactorOfPower(std::pow(transition_parameter, 1.4));
}

State stateOfRing(double transition_parameter, double ring_extent) {
  const double lambda = transition_parameter;
  const double s = ring_extent;
  // Griffith's criterion, 1 = A a^2 + 2 B a, solved for a without cancellation
  const double a_squared_term = 0.5 * lambda * firstBracket(s);
  const double half_a_term = 2.0 / 3.0 * lambda * lambda * secondBracket(s);
  const double a = 1.0 / (half_a_term + std::sqrt(half_a_term * half_a_term + a_squared_term));
  State state;
  state.contact_radius = a;
  state.cohesive_radius = a * std::sqrt(1.0 + s * s);
  state.load = a * a * a - lambda * a * a * (s + (1.0 + s * s) * std::atan(s));
  state.approach = a * a - 4.0 / 3.0 * a * lambda * s;
  return state;
}

double pullOffPrefactor(double transition_parameter) {
  if (transition_parameter < 1e-4) {
    // first order for a vanishing contact, where c = 2/sqrt(pi lambda); the next is 5e-12 here
    const double slope = 16.0 / 3.0 * (0.5 * kPi - 1.0) / std::sqrt(kPi);
    return 2.0 - slope * std::pow(transition_parameter, 1.5);
  }
  if (transition_parameter > 1e4) return 1.5;  // 1.5 + 0.16/lambda^2

  // Golden-section search for the least load over log s. Between the bounds a runs from far above the pull-off
  // contact to far below it, and the load has one minimum.
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto loadAt = [&](double log_s) { return stateOfRing(transition_parameter, std::exp(log_s)).load; };
  double lower = std::log(1e-2 / (1.0 + transition_parameter));
  double upper = std::log(1e8);
  double inner = upper - golden * (upper - lower);
  double outer = lower + golden * (upper - lower);
  double inner_load = loadAt(inner);
  double outer_load = loadAt(outer);
  while (upper - lower > 1e-7) {  // the load is flat at its minimum: an error e in log s costs e^2
    if (inner_load < outer_load) {
      upper = outer;
      outer = inner;
      outer_load = inner_load;
      inner = upper - golden * (upper - lower);
      inner_load = loadAt(inner);
    } else {
      lower = inner;
      inner = outer;
      inner_load = outer_load;
      outer = lower + golden * (upper - lower);
      outer_load = loadAt(outer);
    }
  }
  return -std::fmin(inner_load, outer_load);
}

}  // namespace maugis
}  // namespace mems_stiction
