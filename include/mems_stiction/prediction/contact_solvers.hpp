#pragma once

/// @file
/// The solvers that there are, by the names that approach/formulation takes. Each is one line of the table in
/// contact_solvers.cpp.

#include <memory>
#include <string>
#include <vector>

#include "mems_stiction/contact/contact_solver.hpp"

namespace mems_stiction {

/// The formulation that is used if none is stated.
extern const char* const kDefaultFormulation;

/// Names of the formulations, in the order of the documentation.
const std::vector<std::string>& formulationNames();

/// Why a formulation of earlier versions is refused and what serves instead, as a line for messages; empty for any
/// other name.
std::string retirement(const std::string& formulation);

/// @throw OptionsError if there is no formulation of this name; it lists those that there are.
std::unique_ptr<ContactSolver> makeContactSolver(const std::string& formulation);

}  // namespace mems_stiction
