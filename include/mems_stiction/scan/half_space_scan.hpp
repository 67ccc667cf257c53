#pragma once

/// @file
/// What the half-space is asked about a scan: the surfaces that the asperity model sees, with its settings, so that
/// both answer the same question.
///
///     const HalfSpaceSolver solver(configuration.half_space);
///     const SolvedHalfSpace solution = solver.solve(halfSpaceProblem(prepared, configuration.model));

#include "mems_stiction/half_space/half_space_problem.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/scan/prepared_scan.hpp"

namespace mems_stiction {

/// Materials, interface, water and loads are those of `options`; its approach is not: the half-space has its own.
HalfSpaceProblem halfSpaceProblem(const PreparedScan& prepared, const Options& options);

}  // namespace mems_stiction
