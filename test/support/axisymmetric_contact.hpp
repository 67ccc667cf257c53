#pragma once

/// @file
/// A paraboloid on an elastic half-space under the 9-3 traction, solved on rings: one dimension, no
/// transform, no frame, nothing of the library. Greenwood, Proc. R. Soc. A 453 (1997) 1277 and
/// Feng, Colloids Surf. A 172 (2000) 175 solve the same equation.

namespace mems_stiction {
namespace axisymmetric {

/// Pull-off force over pi Gamma R at a Tabor parameter (R Gamma^2/(E^2 z0^3))^(1/3) > 0, the height
/// prescribed.
/// @param rings_per_cohesive_length E z0^2/Gamma holds so many rings
double pullOff(double tabor, double rings_per_cohesive_length = 4.0);

}  // namespace axisymmetric
}  // namespace mems_stiction
