#include "mechanics/wave_stiffness.hpp"

#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

/// From here on exponentials are small and nothing cancels.
constexpr double kLarge = 1.0;

double kolosov(double poisson_ratio) { return 3.0 - 4.0 * poisson_ratio; }

/// sinh x - x for 0 <= x <= 2 kLarge, to all digits.
double sinhLess(double x) {
  double term = x * x * x / 6.0;
  double sum = 0.0;
  for (int n = 3; sum + term != sum; n += 2) {
    sum += term;
    term *= x * x / ((n + 1.0) * (n + 2.0));
  }
  return sum;
}

}  // namespace

LayerCompliance::LayerCompliance(const Material& material)
    : plane_compliance_((1.0 - material.poisson_ratio * material.poisson_ratio) /
                        material.youngs_modulus),
      thickness_(material.thickness) {
  if (material.backing == Backing::kFree) {
    a_ = b_ = 1.0;
    one_less_a_ = one_less_b_ = one_less_ab_ = 0.0;
    b_and_ab_ = 2.0;
    return;
  }
  const Substrate& substrate = material.substrate;
  const double g = kolosov(material.poisson_ratio);
  const double g0 = kolosov(substrate.poisson_ratio);
  const double r = substrate.youngs_modulus > 0.0
                       ? material.youngs_modulus * (1.0 + substrate.poisson_ratio) /
                             (substrate.youngs_modulus * (1.0 + material.poisson_ratio))
                       : 0.0;
  const double of_a = 1.0 + r * g0;
  const double of_b = r + g;
  a_ = (r * g0 - g) / of_a;
  b_ = (r - 1.0) / of_b;
  one_less_a_ = (1.0 + g) / of_a;
  one_less_b_ = (1.0 + g) / of_b;
  one_less_ab_ = r * (1.0 + g0) * (1.0 + g) / (of_a * of_b);
  b_and_ab_ = b_ * 2.0 * (r * g0 - (1.0 - 2.0 * material.poisson_ratio)) / of_a;
}

double LayerCompliance::ratio(double wave_number) const {
  if (thickness_ == 0.0) return 1.0;
  const double s = wave_number * thickness_;
  const double e = std::exp(-2.0 * s);
  if (e == 0.0) return 1.0;  // s^2 e may be infinity times 0
  if (s > kLarge) {
    return (1.0 + 4.0 * b_ * s * e - a_ * b_ * e * e) /
           ((1.0 - a_ * e) * (1.0 - b_ * e) - 4.0 * b_ * s * s * e);
  }
  const double m = -std::expm1(-2.0 * s);  // 1 - e
  const double bending = sinhLess(s) * (std::sinh(s) + s);
  const double numerator =
      one_less_ab_ + 2.0 * a_ * b_ * e * sinhLess(2.0 * s) + 4.0 * b_and_ab_ * s * e;
  const double denominator = one_less_a_ * one_less_b_ + m * (one_less_a_ * b_ + one_less_b_ * a_) +
                             4.0 * e * (a_ * b_ * bending - b_ * one_less_a_ * s * s);
  return denominator > 0.0 ? numerator / denominator : std::numeric_limits<double>::infinity();
}

double WaveStiffness::modulus(double wave_number) const {
  return 1.0 / (lower_.planeCompliance() * lower_.ratio(wave_number) +
                upper_.planeCompliance() * upper_.ratio(wave_number));
}

}  // namespace mems_stiction
