#pragma once

/// @file
/// Closed forms of single contacts that no program needs and tests judge by. What src/mechanics has
/// of JKR, of Maugis' model and of surface forces goes on here; Hertz' and DMT's contacts stand
/// here alone.
///
///     Hertz     P = K a^3/R,   d = a^2/R,   P = K sqrt(R) d^(3/2),   p0 = 3P/(2 pi a^2),   K =
///     4E/3 JKR       P(a) = K a^3/R - sqrt(6 pi w K a^3),   d(a) = a^2/R - sqrt(8 pi w a/(3K))
///               pull-off at fixed load (3/2) pi w R, at fixed grips (5/6) pi w R
///     DMT       P(a) = K a^3/R - 2 pi w R,   d(a) = a^2/R,   pull-off 2 pi w R at a = 0
///     plates    u = H/(12 pi d^2);   sphere before a plate: F = H R/(6 d^2),   U = H R/(6 d)
///
/// Assumptions, limits and sources: jkr.hpp, transition.hpp and surface_forces.hpp. Hertz: as JKR
/// without adhesion; negative loads and approaches have no contact, and give 0; J. reine angew.
/// Math. 92 (1882) 156; Johnson, Contact Mechanics (1985), (4.22) to (4.24). DMT: the attraction of
/// the gap adds 2 pi w R to the load and leaves Hertz' shape of the contact alone; Derjaguin,
/// Muller and Toporov, J. Colloid Interface Sci. 53 (1975) 314, in the reading of Maugis, J.
/// Colloid Interface Sci. 150 (1992) 243, section 2. Loads below minus its pull-off force have no
/// equilibrium: the contact radius is then NaN. The sphere before a plate is by Derjaguin's
/// approximation, d << R.
///
/// Arguments throughout: load P [N], pressing positive; work_of_adhesion w [J/m^2], >= 0; radius R
/// [m], > 0; contact_modulus E [Pa], > 0; contact_radius a [m], >= 0; approach d [m] of distant
/// points of the two bodies; gap d [m], > 0; hamaker_constant H [J].

#include "mechanics/jkr.hpp"
#include "mechanics/surface_forces.hpp"
#include "mechanics/transition.hpp"

namespace mems_stiction {

namespace hertz {

/// a [m].
double contactRadius(double load, double radius, double contact_modulus);

/// P of a contact radius [N].
double loadOfContact(double contact_radius, double radius, double contact_modulus);

/// d, how far distant points of the bodies come closer [m].
double approach(double load, double radius, double contact_modulus);

/// P of an approach [N].
double load(double approach, double radius, double contact_modulus);

/// p0, the pressure in the middle of the contact [Pa]; 3/2 of the mean pressure.
double maximumPressure(double load, double radius, double contact_modulus);

/// Pressure at a distance r from the axis, p0 sqrt(1 - r^2/a^2), 0 outside the contact [Pa].
double pressure(double distance, double load, double radius, double contact_modulus);

/// Stored elastic energy at an approach, (2/5) P d [J].
double energy(double approach, double radius, double contact_modulus);

}  // namespace hertz

namespace jkr {

/// P(a), the load that holds a contact radius, on the stable and the unstable branch [N].
double load(double contact_radius, double work_of_adhesion, double radius, double contact_modulus);

/// d(a), the approach at a contact radius [m]; negative when adhesion has pulled out a neck.
double approach(double contact_radius, double work_of_adhesion, double radius,
                double contact_modulus);

/// Force that separates the sphere at fixed load, (3/2) pi w R, published positive [N].
double pullOffForce(double work_of_adhesion, double radius);

/// Contact radius at which it comes off at fixed load [m].
double pullOffContactRadius(double work_of_adhesion, double radius, double contact_modulus);

/// Force at which it comes off at fixed grips, (5/6) pi w R, published positive [N].
double fixedGripsPullOffForce(double work_of_adhesion, double radius);

/// Contact radius at which it comes off at fixed grips [m].
double fixedGripsPullOffContactRadius(double work_of_adhesion, double radius,
                                      double contact_modulus);

}  // namespace jkr

namespace dmt {

/// P + 2 pi w R, the load that gives the same contact radius without adhesion [N]. NaN for loads
/// below -pullOffForce().
double apparentLoad(double load, double work_of_adhesion, double radius);

/// Contact radius in equilibrium with a load [m]. NaN for loads below -pullOffForce().
double equilibriumContactRadius(double load, double work_of_adhesion, double radius,
                                double contact_modulus);

/// P(a), the load that holds a contact radius [N].
double load(double contact_radius, double work_of_adhesion, double radius, double contact_modulus);

/// d(a), the approach of distant points of the two bodies at a contact radius [m].
double approach(double contact_radius, double radius);

/// Force that separates the sphere, 2 pi w R, published positive [N].
double pullOffForce(double work_of_adhesion, double radius);

}  // namespace dmt

namespace maugis {

/// lambda of an adhesive stress s0 [Pa] that acts until the gap reaches w/s0 [-].
double transitionParameter(double adhesive_stress, double radius, double work_of_adhesion,
                           double contact_modulus);

/// Pull-off force in units of pi w R [-], exact for Maugis' model, by a numerical search of a few
/// microseconds.
/// @param transition_parameter lambda [-], >= 0
double pullOffPrefactor(double transition_parameter);

/// One state of Maugis' model in his units: length (pi w R^2/K)^(1/3), force pi w R, approach (pi^2
/// w^2 R/K^2)^(1/3).
struct State {
  double contact_radius;   ///< a [-]
  double cohesive_radius;  ///< c, outer radius of the ring in which the stress acts [-]
  double load;             ///< F [-], pressing positive
  double approach;         ///< delta [-]
};

/// The state at which the ring reaches out to c = a sqrt(1 + s^2): s -> 0 is a large contact, s ->
/// infinity a vanishing one.
/// @param transition_parameter lambda [-], > 0
/// @param ring_extent s = sqrt(c^2/a^2 - 1) [-], > 0
State stateOfRing(double transition_parameter, double ring_extent);

}  // namespace maugis

namespace surface_forces {

/// u of parallel plates per area [J/m^2].
double vanDerWaalsEnergy(double gap, double hamaker_constant);

/// F of a sphere before a plate [N].
double vanDerWaalsSphereForce(double gap, double hamaker_constant, double radius);

/// U of a sphere before a plate [J].
double vanDerWaalsSphereEnergy(double gap, double hamaker_constant, double radius);

}  // namespace surface_forces

}  // namespace mems_stiction
