#include "verdict/guided_arm.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/bisection.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kPole = -20.190728556426629;  // tan(q) = q at q = 4.4934, z = -q^2
constexpr double kClosedFormFrom = 10.0;       // below it 30 steps of the fraction are exact
constexpr int kFractionSteps = 30;
constexpr double kRoundOff = 1e-16;

/// r(z) and its derivative.
struct Fraction {
  double value = 0.0;
  double slope = 0.0;
};

Fraction fractionAt(double z) {
  if (z > kClosedFormFrom) {
    const double v = std::sqrt(z);
    const double tangent = std::tanh(v);
    const double rest = v - tangent;
    // d/dz = 1/(2 v) d/dv of z v/rest, with d rest/dv = tanh^2 v
    return {z * v / rest - z - 3.0,
            1.5 * v / rest - 0.5 * z * tangent * tangent / (rest * rest) - 1.0};
  }
  double value = 2.0 * kFractionSteps + 5.0;
  double slope = 0.0;
  for (int step = kFractionSteps - 1; step >= 0; --step) {
    slope = (1.0 - z * slope / value) / value;
    value = 2.0 * step + 5.0 + z / value;
  }
  return {z / value, (1.0 - z * slope / value) / value};
}

}  // namespace

GuidedArm guidedArm(const Beam& beam, double length) {
  const double stretched = 1.5 * std::pow(beam.gap / beam.thickness, 2);
  const double stressed =
      3.0 * beam.residual_stress / beam.modulus * std::pow(length / beam.thickness, 2);
  // 1 + r' lies between 1 and, above z = -pi^2, 3/2
  const double low = std::max(stressed + stretched, kPole * (1.0 - 1e-9));
  const double high = std::max(stressed + 1.5 * stretched, -kPi * kPi);
  GuidedArm arm;
  arm.column = signChange(low, high, kRoundOff, [&](double z) {
    return z - stressed - stretched * (1.0 + fractionAt(z).slope);
  });
  const Fraction fraction = fractionAt(arm.column);
  const double slant = beam.gap / length;
  arm.stretch = 0.5 * slant * slant * (1.0 + fraction.slope);
  const double bending = beam.modulus * std::pow(beam.thickness / length, 3) * beam.gap;
  arm.force = bending / 3.0 * (3.0 + arm.column + fraction.value);
  arm.work =
      0.5 * bending * slant * (3.0 + fraction.value - arm.column * fraction.slope) +
      beam.thickness * arm.stretch * (beam.residual_stress + 1.5 * beam.modulus * arm.stretch);
  return arm;
}

}  // namespace mems_stiction
