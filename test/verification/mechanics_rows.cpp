/// Hertz, JKR, DMT and what lies between: one sphere on a flat, without any grid.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mechanics/jkr.hpp"
#include "mechanics/transition.hpp"
#include "mems_stiction/mechanics/material.hpp"
#include "numeric/constants.hpp"
#include "support/reference_contacts.hpp"
#include "verification/closed_forms.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

constexpr const char* kMaugis = "JKR in Maugis' units (Maugis 1992)";
constexpr const char* kJohnson = "Johnson, Contact Mechanics (1985), chapter 4";
constexpr const char* kPolysilicon = "closed form, E* = 88.7978 GPa";

/// A sphere far from one in every unit.
constexpr double kRadius = 2e-6;
constexpr double kWork = 50e-3;
constexpr double kModulus = closed_form::kPolysiliconModulus;

closed_form::MaugisUnits units() { return {kRadius, kWork, kModulus}; }

double jkrForce(double a) {
  return jkr::load(a * units().length(), kWork, kRadius, kModulus) / units().force();
}
double jkrApproach(double a) {
  return jkr::approach(a * units().length(), kWork, kRadius, kModulus) / units().approach();
}
double jkrEnergy(double a) {
  return jkr::energy(a * units().length(), kWork, kRadius, kModulus) /
         (units().force() * units().approach());
}

}  // namespace

Section hertzSection() {
  // E* = 5, R = 4, F = 7
  const double load = 7.0, radius = 4.0, modulus = 5.0;
  const double approach = hertz::approach(load, radius, modulus);
  Section section{"Hertz", {}};
  section.rows = {
      published("approach, E* = 5, R = 4, F = 7", "", kJohnson, approach, "0.6507879989531481"),
      published("contact radius, same", "", kJohnson, hertz::contactRadius(load, radius, modulus),
                "1.6134286460245437"),
      published("largest pressure, same", "", kJohnson,
                hertz::maximumPressure(load, radius, modulus), "1.2839257217043503"),
      exact("load of that approach", "", "the load put in", hertz::load(approach, radius, modulus),
            7.0),
      exact("load of that contact radius", "", "the load put in",
            hertz::loadOfContact(hertz::contactRadius(load, radius, modulus), radius, modulus),
            7.0),
      exact("stored energy", "", "integral of F by the approach: (2/5) F d",
            hertz::energy(approach, radius, modulus), 0.4 * 7.0 * 0.6507879989531481),
      exact("E of polysilicon on polysilicon", "Pa", "169 GPa/(2 (1 - 0.22^2))",
            ContactPair(Material(), Material()).contact_modulus, 169e9 / (2.0 * (1.0 - 0.0484))),
      published("E of polysilicon, as published", "Pa", "169 GPa and 0.22, Sharpe et al. 1997",
                ContactPair(Material(), Material()).contact_modulus, "88.7978e9"),
  };
  // the pressure over the contact carries the load: rings of equal r^2, midpoint rule
  const double contact = hertz::contactRadius(load, radius, modulus);
  const int rings = 100000;
  double carried = 0.0;
  for (int ring = 0; ring < rings; ++ring) {
    const double r = contact * std::sqrt((ring + 0.5) / rings);
    carried +=
        hertz::pressure(r, load, radius, modulus) * closed_form::kPi * contact * contact / rings;
  }
  section.rows.push_back(near("load carried by the pressure", "", "quadrature over the contact",
                              carried, 7.0, 1e-7, "midpoint rule at a root's end: rings^-1.5"));
  return section;
}

Section jkrSection() {
  const closed_form::MaugisUnits maugis = units();
  const double length = maugis.length();
  const double fixed_load = jkr::pullOffContactRadius(kWork, kRadius, kModulus) / length;
  const double fixed_grips = jkr::fixedGripsPullOffContactRadius(kWork, kRadius, kModulus) / length;
  const double at_rest = jkr::equilibriumContactRadius(0.0, kWork, kRadius, kModulus) / length;
  Section section{"JKR", {}};
  section.rows = {
      published("pull-off at fixed load: a", "Maugis", kMaugis, fixed_load, "1.144714"),
      exact("pull-off at fixed load: F", "Maugis", kMaugis, jkrForce(fixed_load), -1.5),
      published("pull-off at fixed load: approach", "Maugis", kMaugis, jkrApproach(fixed_load),
                "-0.436790"),
      exact("pull-off force at fixed load", "Maugis", "3/2",
            jkr::pullOffForce(kWork, kRadius) / maugis.force(), 1.5),
      published("pull-off at fixed grips: a", "Maugis", kMaugis, fixed_grips, "0.550321"),
      published("pull-off at fixed grips: F", "Maugis", kMaugis, jkrForce(fixed_grips),
                "-0.833333"),
      published("pull-off at fixed grips: approach", "Maugis", kMaugis, jkrApproach(fixed_grips),
                "-0.908560"),
      exact("pull-off force at fixed grips", "Maugis", "5/6",
            jkr::fixedGripsPullOffForce(kWork, kRadius) / maugis.force(), 5.0 / 6.0),
      published("zero load: a", "Maugis", kMaugis, at_rest, "1.817121"),
      near("zero load: F", "Maugis", kMaugis, jkrForce(at_rest), 0.0, 1e-11,
           "round-off of a difference of 6"),
      published("zero load: approach", "Maugis", kMaugis, jkrApproach(at_rest), "1.100642"),
      published("a = 2: F", "Maugis", kMaugis, jkrForce(2.0), "1.071797"),
      published("a = 2: approach", "Maugis", kMaugis, jkrApproach(2.0), "1.690599"),
      published("a = 5: F", "Maugis", kMaugis, jkrForce(5.0), "97.613872"),
      published("a = 5: approach", "Maugis", kMaugis, jkrApproach(5.0), "21.348516"),
  };
  for (const double load : {0.0, 1e-7, 1e-6, 1e-5}) {
    const double a = closed_form::jkrContactRadius(load, kRadius, kWork, kModulus);
    char name[64];
    std::snprintf(name, sizeof name, "(7), apparent load at %g N, R = 2 um", load);
    section.rows.push_back(exact(name, "N", "F = a^3 - a sqrt(6 a) solved by bisection",
                                 jkr::apparentLoad(load, kWork, kRadius),
                                 4.0 / 3.0 * kModulus * a * a * a / kRadius));
  }
  section.rows.push_back(exact("energy at a = 2", "Maugis",
                               "integral of F by the approach, by hand", jkrEnergy(2.0),
                               closed_form::jkrWork(2.0)));
  section.rows.push_back(exact("energy at zero load", "Maugis",
                               "integral of F by the approach, by hand", jkrEnergy(at_rest),
                               closed_form::jkrWork(std::cbrt(6.0))));
  section.rows.push_back(published("pull-off, R = 1 um, 50 mJ/m^2", "N", kPolysilicon,
                                   jkr::pullOffForce(50e-3, 1e-6), "235.619e-9"));
  section.rows.push_back(published("a at zero load, R = 1 um, 50 mJ/m^2", "m", kPolysilicon,
                                   jkr::equilibriumContactRadius(0.0, 50e-3, 1e-6, kModulus),
                                   "19.96687e-9"));
  section.rows.push_back(published("pull-off, R = 100 nm, 10 mJ/m^2", "N", kPolysilicon,
                                   jkr::pullOffForce(10e-3, 100e-9), "4.7124e-9"));
  section.rows.push_back(published("a at zero load, R = 100 nm, 10 mJ/m^2", "m", kPolysilicon,
                                   jkr::equilibriumContactRadius(0.0, 10e-3, 100e-9, kModulus),
                                   "2.51567e-9"));
  return section;
}

Section dmtAndTransitionSection() {
  const closed_form::MaugisUnits maugis = units();
  const char* kTable = "Maugis 1992, solved numerically";
  Section section{"DMT and the transition", {}};
  section.rows = {
      exact("DMT, a = 2: F = a^3 - 2", "Maugis", "Maugis 1992, section 2",
            dmt::load(2.0 * maugis.length(), kWork, kRadius, kModulus) / maugis.force(), 6.0),
      exact("DMT, a = 2: approach = a^2", "Maugis", "Maugis 1992, section 2",
            dmt::approach(2.0 * maugis.length(), kRadius) / maugis.approach(), 4.0),
      exact("DMT, contact radius at F = 6", "Maugis", "Maugis 1992, section 2",
            dmt::equilibriumContactRadius(6.0 * maugis.force(), kWork, kRadius, kModulus) /
                maugis.length(),
            2.0),
      published("DMT pull-off, R = 1 um, 50 mJ/m^2", "N", kPolysilicon,
                dmt::pullOffForce(50e-3, 1e-6), "314.159e-9"),
      published("DMT pull-off, R = 100 nm, 10 mJ/m^2", "N", kPolysilicon,
                dmt::pullOffForce(10e-3, 100e-9), "6.2832e-9"),
  };
  const std::pair<double, const char*> table[] = {
      {0.01, "1.99829"}, {0.1, "1.95059"}, {0.3, "1.81556"}, {0.5, "1.71825"},
      {1.0, "1.60073"},  {2.0, "1.53460"}, {5.0, "1.50635"}};
  for (const auto& entry : table) {
    char name[64];
    std::snprintf(name, sizeof name, "Maugis-Dugdale pull-off, lambda = %g", entry.first);
    section.rows.push_back(
        published(name, "pi w R", kTable, maugis::pullOffPrefactor(entry.first), entry.second));
  }
  double worst = 0.0;
  for (const double lambda : {0.1, 0.5, 1.0}) {
    worst = std::max(worst, 100.0 * std::abs(maugis::fittedPullOffPrefactor(lambda) /
                                                 maugis::pullOffPrefactor(lambda) -
                                             1.0));
  }
  section.rows.push_back(published("largest misfit of the fit at lambda 0.1, 0.5, 1", "%",
                                   "Carpick, Ogletree and Salmeron 1999", worst, "1.2"));
  const double x = 4.04 * std::pow(0.3, 1.4);
  section.rows.push_back(
      exact("the fit at lambda = 0.3", "pi w R", "Carpick, Ogletree and Salmeron 1999",
            maugis::fittedPullOffPrefactor(0.3), 1.75 - 0.25 * (x - 1.0) / (x + 1.0)));
  section.rows.push_back(published("lambda over Tabor's mu", "", "Maugis 1992",
                                   maugis::transitionParameter(1.0), "1.157"));

  const struct {
    double radius;
    const char* far;
    const char* near;
  } asperities[] = {{10e-9, "0.05", "0.09"}, {100e-9, "0.11", "0.19"}, {1e-6, "0.23", "0.41"}};
  for (const auto& asperity : asperities) {
    char name[64];
    std::snprintf(name, sizeof name, "Tabor's mu, polysilicon, R = %g nm, z0 = 0.3 nm",
                  asperity.radius * 1e9);
    section.rows.push_back(published(name, "", "(R w^2/(E^2 z0^3))^(1/3)",
                                     taborParameter(asperity.radius, 50e-3, kModulus, 0.3e-9),
                                     asperity.far));
    std::snprintf(name, sizeof name, "Tabor's mu, polysilicon, R = %g nm, z0 = 0.165 nm",
                  asperity.radius * 1e9);
    section.rows.push_back(published(name, "", "(R w^2/(E^2 z0^3))^(1/3)",
                                     taborParameter(asperity.radius, 50e-3, kModulus, 0.165e-9),
                                     asperity.near));
  }
  const double strain = 50e-3 / (kModulus * 0.2e-9);
  section.rows.push_back(exact("Tabor's mu, R = 250 nm, z0 = 0.2 nm", "", "Tabor 1977",
                               taborParameter(250e-9, 50e-3, kModulus, 0.2e-9),
                               std::pow(250e-9 / 0.2e-9 * strain * strain, 1.0 / 3.0)));
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
