#pragma once

/// @file
/// Which adhesion theory fits an asperity, JKR or DMT, and what is its pull-off force in between?
///
///     mu     = (R w^2/(E^2 z0^3))^(1/3)                                Tabor's parameter
///     lambda = 2 s0 (R/(pi w K^2))^(1/3),  K = 4E/3                    Maugis' parameter
///     lambda = 1.157 mu
///             when s0 is the largest stress of a Lennard-Jones interface, 16 w/(9 sqrt(3) z0)
///     pull-off = p pi w R,  p = 7/4 - (1/4) (4.04 lambda^1.4 - 1)/(4.04 lambda^1.4 + 1)      (fit)
///
/// Assumptions: paraboloid on a half-space, elastic; Maugis lets a constant stress s0 act in a ring
/// around the contact until the gap reaches w/s0 (Dugdale's crack tip). The prefactor p falls from
/// 2 (DMT, mu < 0.1) to 1.5 (JKR, mu > 5). The fit applies to all lambda, within 1.7 % of the exact
/// value (the worst is near lambda = 0.25). Plastic flow, roughness on the asperity and neighbours
/// are in neither. Sources: Tabor, J. Colloid Interface Sci. 58 (1977) 2; Maugis, J. Colloid
/// Interface Sci. 150 (1992) 243; Carpick, Ogletree and Salmeron, J. Colloid Interface Sci. 211
/// (1999) 395.
///
///     const double mu = taborParameter(radius, work_of_adhesion, pair.contact_modulus,
///         equilibrium_distance);
///     const double pull_off = pullOffPrefactor(mu) * kPi * work_of_adhesion * radius;

namespace mems_stiction {

/// mu [-].
/// @param radius R [m], > 0
/// @param work_of_adhesion w [J/m^2], >= 0
/// @param contact_modulus E [Pa], > 0
/// @param equilibrium_distance z0 of the two surfaces [m], > 0
double taborParameter(double radius, double work_of_adhesion, double contact_modulus,
                      double equilibrium_distance);

/// Pull-off force in units of pi w R by the fit [-], in [1.5, 2].
/// @param tabor mu [-], >= 0
double pullOffPrefactor(double tabor);

namespace maugis {

/// lambda of Tabor's parameter [-].
double transitionParameter(double tabor);

/// Pull-off force in units of pi w R by Carpick, Ogletree and Salmeron's fit [-].
/// @param transition_parameter lambda [-], >= 0
double fittedPullOffPrefactor(double transition_parameter);

/// The same of lambda^1.4, one or several.
template <typename Real>
Real fittedPullOffPrefactorOfPower(const Real& transition_parameter_to_1_4) {
  // (x - 1)/(x + 1) as 1 - 2/(x + 1), which is also true at x = infinity
  return 1.5 + 0.5 / (4.04 * transition_parameter_to_1_4 + 1.0);
}

}  // namespace maugis
}  // namespace mems_stiction
