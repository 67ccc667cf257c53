#pragma once

/// @file
/// What the half-space is asked about a scan: the surfaces that the asperity model sees, with its
/// settings, so that both answer the same question.
///
///     const HalfSpaceSolver solver(configuration.half_space);
///     const SolvedHalfSpace solution = solver.solve(halfSpaceProblem(prepared,
///         configuration.model));
///     const Verdict verdict = halfSpaceVerdict(solution, prepared, configuration.model,
///         configuration);

#include <opencv2/core.hpp>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/half_space/half_space_options.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// Materials, interface, water and loads are those of `options`; its approach is not: the
/// half-space has its own.
HalfSpaceProblem halfSpaceProblem(const PreparedScan& prepared, const Options& options);

/// On the device of the configuration, by the half-space if it can judge. Contacts and exponents,
/// which its interval and the doubts about the scan need, are those of a prediction that is made
/// here.
/// - @p options the model's, with the loads that were solved with
/// - @p beside what else is known of the device
Verdict halfSpaceVerdict(const SolvedHalfSpace& solved, const PreparedScan& prepared,
                         const Options& options, const Configuration& configuration,
                         const Evidence& beside = {});

/// Where the surfaces repel each other at rest, with the values of the model's contact map
/// (Regime): apart, elastic, or plastic where the pressure is the hardness of the softer body.
/// CV_8UC1 of the scan's own size: of a refined scan the severest within each pixel. Empty if there
/// is no rest.
/// - @p refinement of the prepared scan
cv::Mat halfSpaceContactMap(const SolvedHalfSpace& solved, const HalfSpaceProblem& problem,
                            const HalfSpaceOptions& options, int refinement);

}  // namespace mems_stiction
