#pragma once

/// @file
/// Closed forms of single contacts that no program needs and tests judge by. What src/mechanics has
/// of JKR, of Maugis' model and of surface forces goes on here; Hertz' contact stands here alone.
///
/// - Hertz:  P = K a^3/R,  d = a^2/R,  P = K sqrt(R) d^(3/2),  p0 = 3P/(2 pi a^2),  K = 4E/3
/// - JKR:    P(a) = K a^3/R - sqrt(6 pi w K a^3),  d(a) = a^2/R - sqrt(8 pi w a/(3K)),
///           pull-off at fixed load (3/2) pi w R
/// - plates: u = H/(12 pi d^2)
///
/// Assumptions, limits and sources: jkr.hpp, transition.hpp and surface_forces.hpp. Hertz: as JKR
/// without adhesion; negative loads and approaches have no contact, and give 0; J. reine angew.
/// Math. 92 (1882) 156; Johnson, Contact Mechanics (1985), (4.22) to (4.24).
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

/// d, how far distant points of the bodies come closer [m].
double approach(double load, double radius, double contact_modulus);

/// P of an approach [N].
double load(double approach, double radius, double contact_modulus);

/// p0, the pressure in the middle of the contact [Pa]; 3/2 of the mean pressure.
double maximumPressure(double load, double radius, double contact_modulus);

}  // namespace hertz

namespace jkr {

/// P(a), the load that holds a contact radius, on the stable and the unstable branch [N].
double load(double contact_radius, double work_of_adhesion, double radius, double contact_modulus);

/// d(a), the approach at a contact radius [m]; negative when adhesion has pulled out a neck.
double approach(double contact_radius, double work_of_adhesion, double radius,
                double contact_modulus);

/// Force that separates the sphere at fixed load, (3/2) pi w R, published positive [N].
double pullOffForce(double work_of_adhesion, double radius);

}  // namespace jkr

namespace maugis {

/// lambda of an adhesive stress s0 [Pa] that acts until the gap reaches w/s0 [-].
double transitionParameter(double adhesive_stress, double radius, double work_of_adhesion,
                           double contact_modulus);

/// Pull-off force in units of pi w R [-], exact for Maugis' model, by a numerical search of a few
/// microseconds.
/// @param transition_parameter lambda [-], from 1e-4 to 1e4
double pullOffPrefactor(double transition_parameter);

}  // namespace maugis

namespace surface_forces {

/// u of parallel plates per area [J/m^2].
double vanDerWaalsEnergy(double gap, double hamaker_constant);

}  // namespace surface_forces

}  // namespace mems_stiction
