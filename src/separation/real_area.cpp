#include "separation/real_area.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// std::tgamma has no values beyond 171. From here on Gamma(x + 1)/Gamma(x + 1/2) is sqrt(x + 1/4)
/// within 1e-6.
constexpr double kManyTimes = 128.0;

/// By how much adhesion widens that part of a paraboloid's contact which repels [-]: from DMT (1)
/// to JKR, as far as Tabor's parameter has come from one to the other.
double wideningOf(const PatchAtRest& patch) {
  const double carried = patch.load.carried;
  const double rim = patch.rim_force;
  if (!(carried > 0.0) || !(rim > 0.0) || !std::isfinite(rim)) return 1.0;
  const double outer = std::max(carried - rim, 0.0);
  const double jkr_load = outer + 1.5 * rim + std::sqrt(3.0 * rim * outer + 2.25 * rim * rim);
  const double jkr_share = 2.0 * (2.0 - patch.prefactor);
  const double root = std::cbrt(1.0 + jkr_share * std::max(jkr_load / carried - 1.0, 0.0));
  // within JKR's contact Hertz' pressure of P1 outweighs the punch's tension where 1 - (r/a)^2 is
  // more than this
  const double pulling = std::sqrt(rim / (3.0 * jkr_load));
  return root * root * (1.0 - jkr_share * pulling);
}

}  // namespace

double touchingShare(double flatness) {
  if (flatness <= 0.0) return 0.5;
  // h ~ r^n, n = 2/m: delta = h(a) sqrt(pi) Gamma(n/2 + 1)/Gamma(n/2 + 1/2) (Sneddon 1965)
  const double growth = 1.0 - flatness;
  const double half = 1.0 / growth;
  const double ratio = half < kManyTimes ? std::tgamma(half + 1.0) / std::tgamma(half + 0.5)
                                         : std::sqrt(half + 0.25);
  return std::pow(std::sqrt(kPi) * ratio, -growth);
}

double touchingShare(double pressure, double contact_modulus, double rms_slope) {
  const double flattening = contact_modulus * rms_slope;
  return flattening > 0.0 ? std::erf(std::sqrt(kPi) * pressure / flattening) : 1.0;
}

double realCells(const PatchAtRest& patch) {
  const double of_bodies = std::min(1.0, touchingShare(patch.load.flatness) * wideningOf(patch));
  // what the layer takes of the overlap bends nothing: there all of it touches
  const double elastic = of_bodies + patch.load.layer_share * (1.0 - of_bodies);
  const double flowing = std::min(1.0, patch.load.carried / patch.capacity);
  return 1.0 + (patch.cells - 1.0) * std::max(elastic, flowing);
}

}  // namespace mems_stiction
