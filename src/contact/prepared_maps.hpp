#pragma once

/// @file
/// The maps of a solution before a solver marks its contacts.

#include "contact/contact_problem.hpp"
#include "mems_stiction/contact/contact_solution.hpp"

namespace mems_stiction {

/// Those maps that output asks for, as of surfaces apart: no cell in contact, both surfaces as they
/// were, a plane level at 0. The others are released.
void prepareMaps(const ContactProblem& problem, ContactSolution& solution);

}  // namespace mems_stiction
