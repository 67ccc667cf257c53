#pragma once

/// @file
/// half_space/enabled: which scans are solved as a half-space beside their prediction, and what
/// that may cost. What the flags of a prediction ask for is bounded (half_space/max_flagged_...),
/// and is not begun where it could not judge; why not is the answer then. What bounds it counts
/// work, not time: the same scan has the same answer everywhere.
///
///     const HalfSpaceCall call = halfSpaceCall(prediction, prepared, options, configuration);
///     if (call.is_made) {
///       solution = answerOf(call, solver, halfSpaceProblem(prepared, options), control);
///       evidence.half_space = &solution;
///       evidence.why_half_space = call.why;
///     }

#include <string>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// Whether a scan with these settings may be solved, so that tables have columns for it. The flags
/// of some formulations ask for nothing (SolverSkills): these are asked for what was published.
bool mayCallHalfSpace(const Configuration& configuration);

/// Whether one scan is solved.
struct HalfSpaceCall {
  bool is_made = false;
  std::string why;        ///< names of the flags that ask for it; empty: every scan is solved
  std::string objection;  ///< why it is not begun all the same; empty if it is
};

/// - @p options the model's, with the load of the frame
/// - @p configuration with the device; its model is not looked at
HalfSpaceCall halfSpaceCall(const Prediction& prediction, const PreparedScan& prepared,
                            const Options& options, const Configuration& configuration);

/// Said before minutes of work: of pixels that are too large for the edges of contacts what follows
/// from that, and which ones to scan with. Empty if they are small enough, or the problem has no
/// solution.
/// - @p options the model's, with the load of the frame
std::string coarsePixelsWarning(const PreparedScan& prepared, const Options& options,
                                const HalfSpaceOptions& half_space);

/// Of a call that is made. What flags ask for and cannot be solved is an unsolved one with the
/// reason.
/// - @p control, throws as of HalfSpaceSolver::solve()
SolvedHalfSpace answerOf(const HalfSpaceCall& call, const HalfSpaceSolver& solver,
                         const HalfSpaceProblem& problem, const HalfSpaceControl& control = {});

}  // namespace mems_stiction
