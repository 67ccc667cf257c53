#pragma once

/// @file
/// By which law, and over which distance, surfaces attract each other.

#include <string>
#include <vector>

#include "mechanics/traction_law.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/mechanics/material.hpp"

namespace mems_stiction {

/// The film of a body, and what is under it.
CoatedBody coatedBody(const Material& body);

/// Gamma, z0 and the tail. z0 is where the attraction gives the work of adhesion, Gamma = H/(16 pi
/// z0^2) without films and retardation, or interface/equilibrium_distance where the Hamaker
/// constant or the work is 0.
AdhesionLaw adhesionLaw(const InterfaceOptions& interface, const Material& lower,
                        const Material& upper);

/// The field of a potential across gap and insulator.
/// - @p voltage U [V]
FieldLaw fieldLaw(double voltage, const InterfaceOptions& interface);

/// z0 [m], > 0, the distance at which flat surfaces neither attract nor repel each other.
double forceRange(const InterfaceOptions& interface, const Material& lower, const Material& upper);

/// Films and constants that do not go together, one line each; empty when all is well.
std::vector<std::string> filmContradictions(const InterfaceOptions& interface,
                                            const Material& lower, const Material& upper);

}  // namespace mems_stiction
