#include "support/reference_contacts.hpp"

#include <cmath>
#include <limits>

#include "numeric/constants.hpp"

namespace mems_stiction {

namespace hertz {

double contactRadius(double load, double radius, double contact_modulus) {
  return load < 0.0 ? 0.0 : std::cbrt(0.75 * load * radius / contact_modulus);
}

double loadOfContact(double contact_radius, double radius, double contact_modulus) {
  return 4.0 / 3.0 * contact_modulus * contact_radius * contact_radius * contact_radius / radius;
}

double approach(double load, double radius, double contact_modulus) {
  const double contact_radius = contactRadius(load, radius, contact_modulus);
  return contact_radius * contact_radius / radius;
}

double load(double approach, double radius, double contact_modulus) {
  return approach < 0.0 ? 0.0
                        : 4.0 / 3.0 * contact_modulus * std::sqrt(radius * approach) * approach;
}

double maximumPressure(double load, double radius, double contact_modulus) {
  return 2.0 / kPi * contact_modulus * contactRadius(load, radius, contact_modulus) /
         radius;  // = 3P/(2 pi a^2), also at P = 0
}

double pressure(double distance, double load, double radius, double contact_modulus) {
  const double contact_radius = contactRadius(load, radius, contact_modulus);
  if (!(std::fabs(distance) < contact_radius)) return 0.0;
  const double fraction = distance / contact_radius;
  return maximumPressure(load, radius, contact_modulus) * std::sqrt(1.0 - fraction * fraction);
}

double energy(double approach, double radius, double contact_modulus) {
  return 0.4 * load(approach, radius, contact_modulus) * approach;
}

}  // namespace hertz

namespace jkr {

double load(double contact_radius, double work_of_adhesion, double radius, double contact_modulus) {
  const double apparent_load = apparentLoadOfContact(contact_radius, radius, contact_modulus);
  return apparent_load - std::sqrt(6.0 * kPi * work_of_adhesion * radius * apparent_load);
}

double approach(double contact_radius, double work_of_adhesion, double radius,
                double contact_modulus) {
  return contact_radius * contact_radius / radius -
         std::sqrt(2.0 * kPi * work_of_adhesion * contact_radius /
                   contact_modulus);  // 8/(3K) = 2/E
}

double pullOffForce(double work_of_adhesion, double radius) {
  return 1.5 * kPi * work_of_adhesion * radius;
}

double pullOffContactRadius(double work_of_adhesion, double radius, double contact_modulus) {
  return contactRadius(1.5 * kPi * work_of_adhesion * radius, radius, contact_modulus);
}

double fixedGripsPullOffForce(double work_of_adhesion, double radius) {
  return 5.0 / 6.0 * kPi * work_of_adhesion * radius;
}

double fixedGripsPullOffContactRadius(double work_of_adhesion, double radius,
                                      double contact_modulus) {
  return contactRadius(kPi * work_of_adhesion * radius / 6.0, radius, contact_modulus);
}

}  // namespace jkr

namespace dmt {

double apparentLoad(double load, double work_of_adhesion, double radius) {
  const double apparent_load = load + pullOffForce(work_of_adhesion, radius);
  return apparent_load < 0.0 ? std::numeric_limits<double>::quiet_NaN() : apparent_load;
}

double equilibriumContactRadius(double load, double work_of_adhesion, double radius,
                                double contact_modulus) {
  return hertz::contactRadius(apparentLoad(load, work_of_adhesion, radius), radius,
                              contact_modulus);
}

double load(double contact_radius, double work_of_adhesion, double radius, double contact_modulus) {
  return hertz::loadOfContact(contact_radius, radius, contact_modulus) -
         pullOffForce(work_of_adhesion, radius);
}

double approach(double contact_radius, double radius) {
  return contact_radius * contact_radius / radius;
}

double pullOffForce(double work_of_adhesion, double radius) {
  return 2.0 * kPi * work_of_adhesion * radius;
}

}  // namespace dmt

namespace maugis {
namespace {

/// s + (s^2 - 1) atan(s), the bracket of Maugis' first term; its leading terms cancel for small s.
double firstBracket(double s) {
  if (s > 0.05) return s + (s * s - 1.0) * std::atan(s);
  const double q = s * s;
  return s * q *
         (4.0 / 3.0 - q * (8.0 / 15.0 - q * (12.0 / 35.0 - q * (16.0 / 63.0 - q * 20.0 / 99.0))));
}

/// s atan(s) - m + 1 with m = sqrt(1 + s^2), the bracket of his second term.
double secondBracket(double s) { return s * std::atan(s) - s * s / (1.0 + std::sqrt(1.0 + s * s)); }

}  // namespace

double transitionParameter(double adhesive_stress, double radius, double work_of_adhesion,
                           double contact_modulus) {
  const double k = 4.0 / 3.0 * contact_modulus;
  return 2.0 * adhesive_stress * std::cbrt(radius / (kPi * work_of_adhesion * k * k));
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

  // Golden-section search for the least load over log s. Between the bounds a runs from far above
  // the pull-off contact to far below it, and the load has one minimum.
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto loadAt = [&](double log_s) {
    return stateOfRing(transition_parameter, std::exp(log_s)).load;
  };
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

namespace surface_forces {

double vanDerWaalsEnergy(double gap, double hamaker_constant) {
  return hamaker_constant / (12.0 * kPi * gap * gap);
}

double vanDerWaalsSphereForce(double gap, double hamaker_constant, double radius) {
  return hamaker_constant * radius / (6.0 * gap * gap);
}

double vanDerWaalsSphereEnergy(double gap, double hamaker_constant, double radius) {
  return hamaker_constant * radius / (6.0 * gap);
}

}  // namespace surface_forces

}  // namespace mems_stiction
