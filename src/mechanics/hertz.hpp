#pragma once

/// @file
/// How does an elastic sphere flatten on a flat without adhesion?
///
///     P = K a^3/R,  K = 4E/3;   d = a^2/R;   P = K sqrt(R) d^(3/2);   p0 = 3P/(2 pi a^2)
///
/// Assumptions: paraboloid on a half-space, both elastic and smooth, a << R, no friction, no adhesion.
/// Applies for a/R below about 0.1 and a mean pressure below about a third of the hardness; beyond it the sphere flows
/// and the contact is larger than said here. Two spheres: R is the composite radius, 1/R = 1/R1 + 1/R2. Negative loads
/// and approaches have no contact: the functions return 0 contact radius, approach and load. Source: Hertz, J. reine
/// angew. Math. 92 (1882) 156; Johnson, Contact Mechanics (1985), (4.22) to (4.24).
///
///     const double contact = hertz::contactRadius(load, radius, pair.contact_modulus);
///     const double depth = hertz::approach(load, radius, pair.contact_modulus);
///
/// Arguments throughout: load P [N]; radius R [m], > 0; contact_modulus E [Pa], > 0; approach d [m]; contact_radius a
/// [m].

namespace mems_stiction {
namespace hertz {

/// a [m].
double contactRadius(double load, double radius, double contact_modulus);

/// d, how far distant points of the bodies come closer [m].
double approach(double load, double radius, double contact_modulus);

/// P of an approach [N].
double load(double approach, double radius, double contact_modulus);

/// P of a contact radius [N].
double loadOfContact(double contact_radius, double radius, double contact_modulus);

/// p0, the pressure in the middle of the contact [Pa]; 3/2 of the mean pressure.
double maximumPressure(double load, double radius, double contact_modulus);

/// Pressure at a distance r from the axis, p0 sqrt(1 - r^2/a^2), 0 outside the contact [Pa].
double pressure(double distance, double load, double radius, double contact_modulus);

/// Stored elastic energy at an approach, (2/5) P d [J].
double energy(double approach, double radius, double contact_modulus);

}  // namespace hertz
}  // namespace mems_stiction
