#pragma once

/// References in words of their own: constants typed in, Maugis' units, equations solved by
/// bisection. Nothing here calls the library.

#include <cmath>

namespace mems_stiction {
namespace verification {
namespace closed_form {

inline constexpr double kPi = 3.141592653589793;
inline constexpr double kVacuumPermittivity = 8.8541878128e-12;  ///< CODATA 2018 [F/m]
inline constexpr double kPolysiliconModulus =
    169e9 / 2.0 / (1.0 - 0.22 * 0.22);  ///< E of two equal bodies [Pa]

/// JKR in units in which F = a^3 - a sqrt(6 a), approach = a^2 - (2/3) sqrt(6 a).
struct MaugisUnits {
  double radius, work_of_adhesion, contact_modulus;

  double stiffness() const { return 4.0 / 3.0 * contact_modulus; }
  double force() const { return kPi * work_of_adhesion * radius; }
  double length() const {
    return std::pow(kPi * work_of_adhesion * radius * radius / stiffness(), 1.0 / 3.0);
  }
  double approach() const {
    return std::pow(
        kPi * kPi * work_of_adhesion * work_of_adhesion * radius / (stiffness() * stiffness()),
        1.0 / 3.0);
  }
};

inline double jkrForce(double a) { return a * a * a - a * std::sqrt(6.0 * a); }
inline double jkrApproach(double a) { return a * a - 2.0 / 3.0 * std::sqrt(6.0 * a); }
/// Integral of F by the approach from a = 0.
inline double jkrWork(double a) {
  return 0.4 * std::pow(a, 5) - 2.0 / 3.0 * std::sqrt(6.0) * std::pow(a, 3.5) + a * a;
}

/// Contact radius of JKR's stable branch under a load >= 0 [m], by bisection.
inline double jkrContactRadius(double load, double radius, double work_of_adhesion,
                               double contact_modulus) {
  const MaugisUnits units{radius, work_of_adhesion, contact_modulus};
  const double force = load / units.force();
  double lower = 1.1447142425533319;  // pull-off, (3/2)^(1/3): F rises from here on
  double upper = lower + 10.0 + std::cbrt(10.0 * force);
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (lower + upper);
    (jkrForce(middle) < force ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper) * units.length();
}

/// Maugis' pull-off force over pi w R at his transition parameter, the load prescribed: his
/// equations (6.24) and (6.25) in his units, solved by bisection for m = c/a at each contact radius
/// a; the largest attraction of all a.
inline double maugisPullOff(double transition_parameter) {
  constexpr int kRadii = 2000;
  constexpr double kLargestRadius = 2.0;  // JKR's is 1.145 at pull-off
  const double lambda = transition_parameter;
  double largest = 0.0;
  for (int i = 1; i <= kRadii; ++i) {
    const double a = kLargestRadius * i / kRadii;
    double lower = 1.0;
    double upper = 1e6;
    for (int halvings = 0; halvings < 200; ++halvings) {
      const double m = 0.5 * (lower + upper);
      const double root = std::sqrt(m * m - 1.0);
      const double angle = std::acos(1.0 / m);
      const double spent = 0.5 * lambda * a * a * (root + (m * m - 2.0) * angle) +
                           4.0 / 3.0 * lambda * lambda * a * (root * angle - m + 1.0);
      (spent < 1.0 ? lower : upper) = m;
    }
    const double m = 0.5 * (lower + upper);
    const double force =
        a * a * a - lambda * a * a * (std::sqrt(m * m - 1.0) + m * m * std::acos(1.0 / m));
    largest = std::fmax(largest, -force);
  }
  return largest;
}

}  // namespace closed_form
}  // namespace verification
}  // namespace mems_stiction
