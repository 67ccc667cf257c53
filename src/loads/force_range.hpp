#pragma once

/// @file
/// Over which distance surfaces attract each other.

#include "mems_stiction/loads/interface.hpp"

namespace mems_stiction {

/// z0 [m], > 0, the distance at which flat surfaces neither attract nor repel each other: that at
/// which the Hamaker constant gives the work of adhesion, Gamma = H/(16 pi z0^2), or
/// interface/equilibrium_distance where one of both is 0.
double forceRange(const InterfaceOptions& interface);

}  // namespace mems_stiction
