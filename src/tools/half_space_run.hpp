#pragma once

/// A solution of the half-space as a program gives it: with progress, with Ctrl-C, and with its curve in a file.

#include <string>

#include "mems_stiction/half_space/half_space_solver.hpp"

namespace mems_stiction {

/// On a terminal it says how far it is, from two seconds on. Ctrl-C ends the program.
/// @throw as HalfSpaceSolver::solve()
SolvedHalfSpace solveWithProgress(const HalfSpaceSolver& solver, const HalfSpaceProblem& problem);

/// Both ways as CSV: height [m], force [N], direction; a line of names first.
/// @throw FileError
void writeCurve(const std::string& path, const SolvedHalfSpace& solution);

}  // namespace mems_stiction
