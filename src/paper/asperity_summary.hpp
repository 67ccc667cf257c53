#pragma once

/// @file
/// From the contacts at equilibrium to what the solution says of them (section 2.3 of the paper):
/// one record per asperity, and the sums over them.

#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "paper/asperity_response.hpp"

namespace mems_stiction {

/// One contact at equilibrium, z apart, which the caller knows.
/// - @p load_share F / sum V, so that F_i = load_share V_i (6)
Asperity asperityAt(const ContactPatch& patch, const CapCouple& caps,
                    const AsperityResponse& response, double load_share, const GapField& field,
                    const AsperityLaw& law, const InterfaceOptions& interface);

/// Fills the figures of `solution` that are sums over its list of asperities: (11) and its
/// variants, the contact area of (7), and (14).
void sumAsperities(const AsperityLaw& law, ContactSolution& solution);

}  // namespace mems_stiction
