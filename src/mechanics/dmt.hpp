#pragma once

/// @file
/// How does an elastic sphere stick to a flat when attraction acts outside the contact only?
///
///     P(a) = K a^3/R - 2 pi w R,  K = 4E/3;   d(a) = a^2/R;   pull-off: 2 pi w R at a = 0
///
/// Assumptions: paraboloid on a half-space, both elastic and smooth, a << R; the attraction of the gap adds 2 pi w R to
/// the load and leaves Hertz' shape of the contact alone (Maugis' reading of the theory).
/// Applies to stiff, small, weakly sticking spheres: Tabor's parameter below about 0.1 (transition.hpp), where most
/// polysilicon asperities of 10 nm radius lie. Above, the pull-off falls to JKR's 1.5 pi w R (jkr.hpp).
/// Loads below minus the pull-off force have no equilibrium: the contact radius is then NaN.
/// Source: Derjaguin, Muller and Toporov, J. Colloid Interface Sci. 53 (1975) 314; Maugis, J. Colloid Interface Sci.
/// 150 (1992) 243, section 2.
///
///     const double contact = dmt::equilibriumContactRadius(load, work_of_adhesion, radius, pair.contact_modulus);
///
/// Arguments throughout: load P [N], pressing positive; work_of_adhesion w [J/m^2], >= 0; radius R [m], > 0;
/// contact_modulus E [Pa], > 0; contact_radius a [m], >= 0.

namespace mems_stiction {
namespace dmt {

/// P + 2 pi w R, the load that gives the same contact radius without adhesion [N]. NaN for loads below -pullOffForce().
double apparentLoad(double load, double work_of_adhesion, double radius);

/// Contact radius in equilibrium with a load [m]. NaN for loads below -pullOffForce().
double equilibriumContactRadius(double load, double work_of_adhesion, double radius, double contact_modulus);

/// P(a), the load that holds a contact radius [N].
double load(double contact_radius, double work_of_adhesion, double radius, double contact_modulus);

/// d(a), the approach of distant points of the two bodies at a contact radius [m].
double approach(double contact_radius, double radius);

/// Force that separates the sphere, 2 pi w R, published positive [N].
double pullOffForce(double work_of_adhesion, double radius);

}  // namespace dmt
}  // namespace mems_stiction
