#pragma once

/// @file
/// What the half-space answers.
///
///     if (solution.status != HalfSpaceStatus::kSolved) report(solution.message);
///     if (solution.is_resolved) use(solution.pull_off_force, solution.retraction);

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/half_space/half_space_options.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// One height of the curve.
struct ForcePoint {
  double height = 0.0;  ///< Z over first touch of the undeformed surfaces [m]; negative: pressed in
  double force = 0.0;   ///< attraction of the frame, positive pulls the bodies together [N]
  double energy =
      0.0;  ///< of tractions and elastic deformation, 0 far apart; flow is not in it [J]
  double contact_area = 0.0;  ///< cells that repel each other [m^2]
  double mean_gap = 0.0;      ///< [m]
  bool is_solved =
      true;  ///< false: from the parabola between two solved heights, which contact and gap follow
};

enum class HalfSpaceStatus : std::uint8_t {
  kSolved,  ///< came to rest and, unless half_space/path is rest, came apart: all figures of that
            ///< are known
  kLoadNotReached,  ///< the surfaces are flat against each other and still carry less than the
                    ///< mechanical load
  kNotConverged,    ///< one state found no equilibrium within max_newton_steps
  kTooManyStates,   ///< max_states did not suffice
  kCancelled
};

/// "SOLVED", "LOAD_NOT_REACHED", "NOT_CONVERGED", "TOO_MANY_STATES", "CANCELLED"
const char* word(HalfSpaceStatus status);

/// The answer. Figures that were not reached are NaN; the curves have every state that was solved.
/// Forces and areas are of the frame; attraction is positive.
struct SolvedHalfSpace {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  HalfSpaceStatus status = HalfSpaceStatus::kCancelled;
  std::string message;  ///< the status in a sentence
  HalfSpacePath path =
      HalfSpacePath::kWhole;  ///< that was asked for: of the rest alone no force is known

  double pull_off_force = kNone;  ///< largest force of the retraction, without voltage and load [N]
  double pull_off_uncertainty = kNone;  ///< by which finer steps may exceed it [N]
  double pull_off_height = kNone;       ///< where the upper body is then, over first touch [m]
  double work_of_adhesion =
      kNone;  ///< apparent: from zero force to apart, per area of the valid cells [J/m^2]
  double hysteresis =
      kNone;  ///< work of the retraction less that of the approach, per area [J/m^2]
  double rest_height = kNone;       ///< of the upper body at rest under the mechanical load [m]
  double rest_force = kNone;        ///< there; minus the mechanical load [N]
  double contact_area = kNone;      ///< at rest, cells that repel each other [m^2]
  double contact_fraction = kNone;  ///< the same over the area of the valid cells [-]
  int contact_count = -1;           ///< at rest, connected groups of them; -1: not known
  double mean_gap = kNone;          ///< at rest, of the valid cells [m]
  /// By which the force changes with the height as the bodies leave rest; NaN where the first step
  /// from there jumps or finds no equilibrium, too [N/m].
  double contact_stiffness = kNone;
  double flowed_volume = kNone;  ///< that both surfaces have lost [m^3]
  double range = kNone;          ///< z0 [m]
  double cohesive_length =
      kNone;  ///< E z0^2/Gamma, or E d/p of water: over which contacts part [m]
  bool is_converged =
      false;  ///< kSolved: all of the path, each state to half_space/tolerance where it counts
  bool may_tilt = false;           ///< HalfSpaceProblem::may_tilt: another plane would be its rest
  bool is_resolved = false;        ///< pixels are small enough for the cohesive length
  bool is_step_converged = false;  ///< finer steps change the pull-off force by less than 2 %
  double residual = kNone;         ///< the largest at rest and near the largest force [-]
  int state_count = 0;             ///< solved
  int newton_steps = 0;
  int products = 0;                ///< pairs of Fourier transforms of the whole grid
  int jumps = 0;                   ///< places where the curve is not continuous, both ways
  double processing_time = kNone;  ///< that the solution took [s]
  /// Largest force of a second retraction from the same rest, on which the voltage stays on;
  /// pull_off_force without one [N]. In no curve.
  double pull_off_force_under_voltage = kNone;

  std::vector<ForcePoint> approach;    ///< from apart to rest
  std::vector<ForcePoint> retraction;  ///< from rest to apart, the voltage having gone at rest

  cv::Mat pressure;  ///< at rest, positive where surfaces repel [Pa]; CV_32FC1, NaN where not valid
  cv::Mat gap;       ///< at rest, z0 where the traction vanishes [m]; CV_32FC1, NaN where not valid
  HeightMap deformed_lower;  ///< after contact: what flowed is missing [m]
  HeightMap deformed_upper;  ///< the same of the upper surface; empty if it is flat and harder
};

}  // namespace mems_stiction
