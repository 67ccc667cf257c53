#pragma once

/// @file
/// What else is known of a device's adhesion than the prediction of a scan: what surfaces of the
/// device's size say, the half-space's answer, and how far the choice of cleaning moves it. A
/// verdict takes all into account (verdict.hpp).
///
///     Evidence evidence;
///     evidence.cleaning = CleaningReach{{0.9, 1.3}, {0.8, 1.1}};  // of force and work
///     evidence.half_space = &solution;
///     const Verdict verdict = verdictOf(prediction, device, uncertainty, options, cell_area,
///         evidence);

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// A figure under the cleanings that count, over the one that is configured [-]: lowest <= 1 <=
/// highest.
struct FactorRange {
  double lowest = 1.0;
  double highest = 1.0;
};

/// How far the choice of cleaning moves a prediction.
struct CleaningReach {
  FactorRange pull_off;
  FactorRange apparent_work;
};

/// What surfaces of the device's size say of its adhesion, in plain numbers.
struct DeviceEvidence {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double pull_off_force = kUnknown;             ///< of the whole device [N]
  double apparent_work_of_adhesion = kUnknown;  ///< per nominal area of the device [J/m^2]
  /// Samples of force and work over the figures above, ascending [-]: constants, model, and what
  /// the scans leave open.
  std::vector<double> force_factors;
  std::vector<double> work_factors;
  /// The same where a half-space has answered what the curve doubts; empty: it doubts nothing.
  std::vector<double> force_factors_without_doubt;
  std::vector<double> work_factors_without_doubt;
  /// Contacts that the force rests on: those of the scans where the device's places are cut from
  /// them, as many as that stands for where surfaces were made, whose scatter is in the samples.
  int contacts = std::numeric_limits<int>::max();
  /// What of the samples the scans leave open: reach of ln force to either side, 95 % [-].
  double surface_reach = kUnknown;
  double linear_pull_off_force = kUnknown;  ///< the scans' force by area, for comparison [N]
  std::vector<std::string> warnings;        ///< about the scans, in words
  std::string missing_scan;  ///< that no scan stands for: whatIsMissing(); empty: none
};

/// Each may be missing.
struct Evidence {
  const SolvedHalfSpace* half_space =
      nullptr;                 ///< of the same scan, settings and load, if it was asked
  std::string why_half_space;  ///< flags that ask for it, if they do; empty: every scan has one
  std::optional<CleaningReach> cleaning;  ///< if other cleanings were tried
  std::optional<DeviceEvidence>
      device;                    ///< of the same surface, settings and load, if it was found
  std::string why_no_device;     ///< where it is missing, why and what to do; empty: nobody asked
  std::string where_half_space;  ///< where it will be found that why_half_space asks for
};

/// The figures of the device over those of one frame, both made under the same load. Under other
/// loads, and on surfaces that contacts have changed, the device is taken to follow the frame.
struct DeviceScale {
  DeviceEvidence device;
  double frame_pull_off_force = DeviceEvidence::kUnknown;  ///< [N]
  double frame_work = DeviceEvidence::kUnknown;  ///< apparent work of adhesion of the frame [J/m^2]

  /// - @p contact of the same frame
  DeviceEvidence under(const Prediction& contact) const;
};

/// Beside one of several loads.
struct LoadedScale {
  double voltage = 0.0;          ///< size of it [V]
  double mechanical_load = 0.0;  ///< on the frame [N]
  DeviceScale scale;
};

/// Whether figures can be multiplied with it: a number > 0.
bool isScale(double factor);

/// Force, work and linear rule times the given factors; samples and warnings stay. A factor that is
/// not a number > 0 leaves its figure as it is.
DeviceEvidence scaled(DeviceEvidence device, double force_factor, double work_factor);

/// A half-space that could not be asked.
/// - @p reason why, in a sentence
SolvedHalfSpace unsolvedHalfSpace(const std::string& reason);

/// Why a half-space of which only rest was solved cannot judge.
inline constexpr const char* kRestAlone = "half_space/path is rest, which knows no pull-off force";

/// Why a half-space of a plate that may tilt cannot judge.
inline constexpr const char* kMayTilt =
    "with device/guidance free the plate tilts, and a half-space leaves it as the scan shows it";

/// What a half-space that cannot judge for its pixels asks for.
inline constexpr const char* kPixelsTooLarge =
    "its pixels are too large for the edges of the contacts: scan a smaller area with finer pixels";

/// Why a half-space cannot judge, in words: it is not solved, not converged, its plate may tilt,
/// its pixels are too large for the edges of the contacts, or its steps for the pull-off force.
/// Empty if it can.
std::string whyNotJudging(const SolvedHalfSpace& solution);

/// The prediction with the half-space's pull-off force and apparent work of adhesion in the place
/// of its own; contacts, exponents and flags stay. It is in equilibrium: what did not end was the
/// formulation's search.
Prediction withHalfSpace(const Prediction& prediction, const SolvedHalfSpace& solution);

/// Standard deviation of the logarithm of the half-space's figures [-]: 2 % for the pixels (on a
/// sphere one per cohesive length is 2.4 % off and two are 0.2 %, doc/verification.md; on rough
/// frames it is not known as well), and what finer steps may add to the pull-off force.
double halfSpaceError(const SolvedHalfSpace& solution);

}  // namespace mems_stiction
