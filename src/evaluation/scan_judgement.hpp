#pragma once

/// @file
/// A scan is judged by one rule, whoever asks: the half-space where the scan's flags ask for it,
/// then the verdict, and a device's force as the judge moves it.
///
///     const ScanJudgement found =
///         judgedScan(prediction, prepared, options, configuration, evidence, &force, run);

#include <functional>
#include <optional>

#include "evaluation/half_space_call.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/verdict/evidence.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// Watches a solution of the half-space while it is made: calls what it is given, and returns what
/// that returns.
using HalfSpaceRun = std::function<SolvedHalfSpace(
    const std::function<SolvedHalfSpace(const HalfSpaceControl&)>& solve)>;

/// What a scan is judged by, and how.
struct ScanJudgement {
  HalfSpaceCall call;
  SolvedHalfSpace half_space;      ///< where call.is_made
  std::optional<Verdict> verdict;  ///< where the device states what is to open it

  /// Of a call that was begun.
  std::optional<SolvedHalfSpace> begun() const;
};

/// - @p options the model's, with the load of the frame
/// - @p evidence beside the half-space
/// - @p force of evidence.device; nullptr where there is none. Takes the figures by which the
/// half-space judges
ScanJudgement judgedScan(const Prediction& prediction, const PreparedScan& prepared,
                         const Options& options, const Configuration& configuration,
                         Evidence evidence, DeviceForce* force, const HalfSpaceRun& run);

}  // namespace mems_stiction
