#pragma once

/// @file
/// How does an elastic sphere stick to a flat when attraction acts inside the contact only?
///
///     P1    = P + 3 pi w R + sqrt(6 pi w R P + (3 pi w R)^2)           apparent load (7)
///     a^3   = R P1/K,  K = 4E/3
///     pull-off (3/2) pi w R, at fixed load
///
/// Assumptions: paraboloid on a half-space, both elastic and smooth, a << R, no force outside the
/// contact, no friction. Applies to compliant, large, sticky spheres: Tabor's parameter above about
/// 5 (transition.hpp). Outside, towards Tabor's parameter 0.1 and below, the pull-off grows to
/// DMT's 2 pi w R. Two spheres: R is the composite radius, 1/R = 1/R1 + 1/R2. w = 0 is Hertz. Loads
/// below minus the pull-off force have no equilibrium: the functions then return NaN. Source:
/// Johnson, Kendall and Roberts, Proc. R. Soc. A 324 (1971) 301; (7) is that of Deladi et al. 2002.
///
///     const double apparent = jkr::apparentLoad(load, work_of_adhesion, radius);
///     const double contact = jkr::contactRadius(apparent, radius, pair.contact_modulus);
///
/// Arguments throughout: load P [N], pressing positive; apparent_load P1 [N], >= 0;
/// work_of_adhesion w [J/m^2], >= 0; radius R [m], > 0; contact_modulus E [Pa], > 0; contact_radius
/// a [m], >= 0; approach d [m] of distant points of the two bodies, positive when they come closer
/// than at an undeformed touch.

namespace mems_stiction {
namespace jkr {

/// P1 of (7), the load that gives the same contact radius without adhesion [N]. The stable branch:
/// P1 grows with P. NaN for loads below -(3/2) pi w R.
double apparentLoad(double load, double work_of_adhesion, double radius);

/// Contact radius that belongs to an apparent load [m].
double contactRadius(double apparent_load, double radius, double contact_modulus);

/// The inverse of contactRadius(): P1 = K a^3/R [N].
double apparentLoadOfContact(double contact_radius, double radius, double contact_modulus);

/// Contact radius in equilibrium with a load [m], on the stable branch. NaN for loads below -(3/2)
/// pi w R.
double equilibriumContactRadius(double load, double work_of_adhesion, double radius,
                                double contact_modulus);

/// Work needed to bring the sphere from afar to a contact radius: stored elastic energy less pi w
/// a^2 [J]. Its derivative by the approach is the load.
double energy(double contact_radius, double work_of_adhesion, double radius,
              double contact_modulus);

}  // namespace jkr
}  // namespace mems_stiction
