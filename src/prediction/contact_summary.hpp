#pragma once

/// @file
/// From what a solver has found to the figures that are published.

#include <vector>

#include "contact/contact_problem.hpp"
#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// Fills everything in `prediction` that follows from the solution, and moves its lists and maps
/// there. Figures that the solver does not have are NaN, their words "unknown".
/// - @p values working memory
void summarizeContact(const ContactProblem& problem, ContactSolution& solution,
                      std::vector<double>& values, Prediction& prediction);

}  // namespace mems_stiction
