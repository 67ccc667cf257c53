/// Nominally flat surfaces of many summits: the library's single-asperity laws, averaged over
/// Gaussian heights by quadrature, against the published tables.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mechanics/jkr.hpp"
#include "numeric/constants.hpp"
#include "support/reference_contacts.hpp"
#include "verification/closed_forms.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

constexpr double kRadius = 300e-9;
constexpr double kModulus = closed_form::kPolysiliconModulus;
constexpr double kWork = 50e-3;

double normalDensity(double height) {
  return std::exp(-0.5 * height * height) / std::sqrt(2.0 * closed_form::kPi);
}

/// F_1.5(h) from Hertz' law: the mean load per summit over (4/3) E sqrt(R) sigma^1.5, by Simpson's
/// rule in u = sqrt(s - h), where the integrand is smooth.
double greenwoodWilliamson(double separation) {
  const double sigma = 4e-9;
  const int intervals = 2000;
  const double end = std::sqrt(12.0);
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double u = end * i / intervals;
    const double weight = i == 0 || i == intervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * hertz::load(u * u * sigma, kRadius, kModulus) *
           normalDensity(separation + u * u) * 2.0 * u;
  }
  const double mean_load = sum * end / intervals / 3.0;
  return mean_load / (4.0 / 3.0 * kModulus * std::sqrt(kRadius) * std::pow(sigma, 1.5));
}

/// Largest tension over all separations, per summit and over (3/2) pi w R: each summit follows
/// JKR's branch down to its pull-off at fixed grips. theta = E sigma^1.5/(w sqrt(R)).
double fullerTabor(double theta) {
  const double sigma = std::pow(theta * kWork * std::sqrt(kRadius) / kModulus, 2.0 / 3.0);
  const double first = jkr::fixedGripsPullOffContactRadius(kWork, kRadius, kModulus);
  const auto tension = [&](double separation) {
    // over the contact radius, by the trapezoidal rule in the approach
    const double farthest = (std::max(0.0, 8.0 - separation)) * sigma;
    double sum = 0.0;
    double a = first;
    double approach = jkr::approach(a, kWork, kRadius, kModulus);
    double load = jkr::load(a, kWork, kRadius, kModulus);
    double density = normalDensity(separation + approach / sigma);
    while (approach < farthest) {
      a *= 1.0 + 2e-4;
      const double next_approach = jkr::approach(a, kWork, kRadius, kModulus);
      const double next_load = jkr::load(a, kWork, kRadius, kModulus);
      const double next_density = normalDensity(separation + next_approach / sigma);
      sum -= 0.5 * (load * density + next_load * next_density) * (next_approach - approach) / sigma;
      approach = next_approach;
      load = next_load;
      density = next_density;
    }
    return sum;
  };
  // one maximum: a third of the interval goes each time
  const double neck = -jkr::approach(first, kWork, kRadius, kModulus) / sigma;
  double lower = -6.0 - 3.0 * neck;
  double upper = neck + 6.0;
  while (upper - lower > 1e-5) {
    const double third = (upper - lower) / 3.0;
    if (tension(lower + third) < tension(upper - third)) {
      lower += third;
    } else {
      upper -= third;
    }
  }
  return tension(0.5 * (lower + upper)) / jkr::pullOffForce(kWork, kRadius);
}

}  // namespace

Section manyAsperitiesSection() {
  Section section{"Many asperities", {}};
  const std::pair<double, const char*> integrals[] = {
      {0.0, "0.430020"}, {1.0, "0.075668"}, {2.0, "0.006648"}, {3.0, "0.000264"}};
  char name[64];
  for (const auto& entry : integrals) {
    std::snprintf(name, sizeof name, "F_1.5(%g) by Hertz' law", entry.first);
    section.rows.push_back(published(name, "", "Greenwood and Williamson 1966",
                                     greenwoodWilliamson(entry.first), entry.second));
  }
  const std::pair<double, const char*> pull_offs[] = {
      {0.1, "0.98879"}, {0.5, "0.87997"},  {1.0, "0.73346"},  {2.0, "0.51190"},
      {5.0, "0.18548"}, {10.0, "0.03642"}, {15.0, "7.083e-3"}};
  for (const auto& entry : pull_offs) {
    std::snprintf(name, sizeof name, "pull-off by JKR's law, theta = %g", entry.first);
    section.rows.push_back(published(name, "N 3/2 pi w R", "Fuller and Tabor 1975",
                                     fullerTabor(entry.first), entry.second));
  }
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
