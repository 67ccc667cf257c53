#pragma once

/// @file
/// One table of the figures of a SolvedHalfSpace that records hold: name, member, unit. Figures that the asperity
/// model has too have its names (prediction/prediction_fields.hpp).
///
///     visitHalfSpaceFields(solution, [&](const char* name, const auto& value, const char* unit) { print(...); });
///
/// Values are double, int, bool and the enumerations below; word() makes words of these.

#include <vector>

#include "mems_stiction/contact/curve_point.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"

namespace mems_stiction {

/// "SOLVED", "LOAD_NOT_REACHED", "NOT_CONVERGED", "TOO_MANY_STATES", "CANCELLED"
inline const char* word(HalfSpaceStatus status) {
  switch (status) {
    case HalfSpaceStatus::kSolved:
      return "SOLVED";
    case HalfSpaceStatus::kLoadNotReached:
      return "LOAD_NOT_REACHED";
    case HalfSpaceStatus::kNotConverged:
      return "NOT_CONVERGED";
    case HalfSpaceStatus::kTooManyStates:
      return "TOO_MANY_STATES";
    case HalfSpaceStatus::kCancelled:
      break;
  }
  return "CANCELLED";
}

/// The points of both ways in the order in which they were met; the one at rest is there twice.
inline std::vector<CurvePoint> curveOf(const SolvedHalfSpace& solution) {
  std::vector<CurvePoint> curve;
  for (const ForcePoint& point : solution.approach) {
    curve.push_back({point.height, point.force, CurveDirection::kApproach});
  }
  for (const ForcePoint& point : solution.retraction) {
    curve.push_back({point.height, point.force, CurveDirection::kRetraction});
  }
  return curve;
}

/// The figures; curveOf() is beside them.
/// @param solution as solved, or as far as it came
/// @param visit called with (name, value, unit) for each figure
template <typename Visitor>
void visitHalfSpaceFields(const SolvedHalfSpace& solution, Visitor&& visit) {
  visit("status", solution.status, "");
  visit("pull_off_force", solution.pull_off_force, "N");
  visit("contact_area", solution.contact_area, "m^2");
  visit("contact_fraction", solution.contact_fraction, "");
  visit("mean_gap", solution.mean_gap, "m");
  visit("apparent_work_of_adhesion", solution.work_of_adhesion, "J/m^2");
  visit("adhesion_hysteresis", solution.hysteresis, "J/m^2");
  visit("is_converged", solution.is_converged, "");
  visit("is_resolved", solution.is_resolved, "");
  visit("iterations", solution.newton_steps, "");
  visit("processing_time", solution.processing_time, "s");
  visit("pull_off_force_under_voltage", solution.pull_off_force_under_voltage, "N");
}

}  // namespace mems_stiction
