/// The contact modulus, JKR and what lies between it and DMT: one sphere on a flat, without any
/// grid.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mechanics/jkr.hpp"
#include "mechanics/transition.hpp"
#include "mems_stiction/mechanics/material.hpp"
#include "support/reference_contacts.hpp"
#include "verification/closed_forms.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

constexpr const char* kMaugis = "JKR in Maugis' units (Maugis 1992)";
constexpr const char* kPolysilicon = "closed form, E* = 88.7978 GPa";

/// A sphere far from one in every unit.
constexpr double kRadius = 2e-6;
constexpr double kWork = 50e-3;
constexpr double kModulus = closed_form::kPolysiliconModulus;

closed_form::MaugisUnits units() { return {kRadius, kWork, kModulus}; }

double jkrEnergy(double a) {
  return jkr::energy(a * units().length(), kWork, kRadius, kModulus) /
         (units().force() * units().approach());
}

}  // namespace

Section jkrSection() {
  const closed_form::MaugisUnits maugis = units();
  const double length = maugis.length();
  const double at_rest = jkr::equilibriumContactRadius(0.0, kWork, kRadius, kModulus) / length;
  Section section{"JKR and the contact modulus", {}};
  section.rows = {
      exact("E of polysilicon on polysilicon", "Pa", "169 GPa/(2 (1 - 0.22^2))",
            ContactPair(Material(), Material()).contact_modulus, 169e9 / (2.0 * (1.0 - 0.0484))),
      published("E of polysilicon, as published", "Pa", "169 GPa and 0.22, Sharpe et al. 1997",
                ContactPair(Material(), Material()).contact_modulus, "88.7978e9"),
      published("zero load: a", "Maugis", kMaugis, at_rest, "1.817121"),
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
  section.rows.push_back(published("a at zero load, R = 1 um, 50 mJ/m^2", "m", kPolysilicon,
                                   jkr::equilibriumContactRadius(0.0, 50e-3, 1e-6, kModulus),
                                   "19.96687e-9"));
  section.rows.push_back(published("a at zero load, R = 100 nm, 10 mJ/m^2", "m", kPolysilicon,
                                   jkr::equilibriumContactRadius(0.0, 10e-3, 100e-9, kModulus),
                                   "2.51567e-9"));
  return section;
}

Section transitionSection() {
  Section section{"Between JKR and DMT", {}};
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
