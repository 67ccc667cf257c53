#include "support/reference_contacts.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {

namespace hertz {

double contactRadius(double load, double radius, double contact_modulus) {
  return load < 0.0 ? 0.0 : std::cbrt(0.75 * load * radius / contact_modulus);
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

}  // namespace jkr

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

/// F in units of pi w R of the state at which the ring reaches out to c = a sqrt(1 + s^2): s -> 0
/// is a large contact, s -> infinity a vanishing one.
double loadOfRing(double lambda, double s) {
  // Griffith's criterion, 1 = A a^2 + 2 B a, solved for a without cancellation
  const double a_squared_term = 0.5 * lambda * firstBracket(s);
  const double half_a_term = 2.0 / 3.0 * lambda * lambda * secondBracket(s);
  const double a = 1.0 / (half_a_term + std::sqrt(half_a_term * half_a_term + a_squared_term));
  return a * a * a - lambda * a * a * (s + (1.0 + s * s) * std::atan(s));
}

}  // namespace

double transitionParameter(double adhesive_stress, double radius, double work_of_adhesion,
                           double contact_modulus) {
  const double k = 4.0 / 3.0 * contact_modulus;
  return 2.0 * adhesive_stress * std::cbrt(radius / (kPi * work_of_adhesion * k * k));
}

double pullOffPrefactor(double transition_parameter) {
  // Golden-section search for the least load over log s. Between the bounds a runs from far above
  // the pull-off contact to far below it, and the load has one minimum.
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto loadAt = [&](double log_s) {
    return loadOfRing(transition_parameter, std::exp(log_s));
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

}  // namespace surface_forces

}  // namespace mems_stiction
