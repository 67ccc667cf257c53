#pragma once

/// @file
/// The figures of a SolvedHalfSpace: name, unit, what it is, and the member that holds it. Those
/// that the asperity model has too have its names (prediction/prediction_fields.hpp).
///
///     visitHalfSpaceFields(solution, [&](const Figure& figure, const auto& value) {
///         print(figure.name, value); });
///
/// Values are double, int, bool and the enumerations below; word() makes words of these.

#include <vector>

#include "contact/curve_point.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {

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

/// The figures of records and rows; curveOf() is beside them.
/// @param solution as solved, or as far as it came
/// @param visit called with (Figure, value) for each
template <typename Visitor>
void visitHalfSpaceFields(const SolvedHalfSpace& solution, Visitor&& visit) {
  visit({"status", "", "SOLVED, LOAD_NOT_REACHED, NOT_CONVERGED, TOO_MANY_STATES or CANCELLED"},
        solution.status);
  visit({"pull_off_force", "N",
         "largest attraction while the bodies are drawn apart, after voltage and load have gone"},
        solution.pull_off_force);
  visit({"contact_area", "m^2", "cells that repel each other at rest"}, solution.contact_area);
  visit({"contact_fraction", "", "contact_area over the area of the valid cells"},
        solution.contact_fraction);
  visit({"mean_gap", "m", "at rest, over the valid cells"}, solution.mean_gap);
  visit({"apparent_work_of_adhesion", "J/m^2",
         "from zero force to apart, per area of the valid cells"},
        solution.work_of_adhesion);
  visit({"adhesion_hysteresis", "J/m^2",
         "what a whole cycle costs, by jumps and by flow, per area of the valid cells"},
        solution.hysteresis);
  visit({"is_converged", "",
         "status is SOLVED: the path came to its end, and every state of it is an equilibrium, to "
         "half_space/tolerance where it counts"},
        solution.is_converged);
  visit({"is_resolved", "",
         "pixels are small enough for the edge of a contact: at least two per cohesive_length"},
        solution.is_resolved);
  visit({"iterations", "", "Newton steps of all states"}, solution.newton_steps);
  visit({"processing_time", "s", "wall time of the solution"}, solution.processing_time);
  visit({"pull_off_force_under_voltage", "N", "largest attraction if the voltage stays on instead"},
        solution.pull_off_force_under_voltage);
}

/// One of records, rows and Python that the message does not have.
template <typename Visitor>
void visitHalfSpaceStiffness(const SolvedHalfSpace& solution, Visitor&& visit) {
  visit({"contact_stiffness", "N/m",
         "by which the force changes with the height as the bodies leave rest"},
        solution.contact_stiffness);
}

/// The others, of message and Python.
template <typename Visitor>
void visitHalfSpaceDetails(const SolvedHalfSpace& solution, Visitor&& visit) {
  visit({"message", "", "the status in a sentence"}, solution.message);
  visit({"pull_off_uncertainty", "N", "by which finer steps may exceed pull_off_force"},
        solution.pull_off_uncertainty);
  visit({"pull_off_height", "m", "of the upper body then, over first touch"},
        solution.pull_off_height);
  visit({"rest_height", "m", "of the upper body at rest, over first touch"}, solution.rest_height);
  visit({"rest_force", "N", "there: minus the mechanical load"}, solution.rest_force);
  visit({"contact_count", "", "connected groups of the cells in contact"}, solution.contact_count);
  visit({"flowed_volume", "m^3", "that both surfaces have lost for good, after the whole path"},
        solution.flowed_volume);
  visit({"range", "m", "z0, the gap at which the traction changes its sign"}, solution.range);
  visit({"cohesive_length", "m",
         "E z0^2/Gamma, or E d/p of water, over which the edge of a contact parts"},
        solution.cohesive_length);
  visit({"is_step_converged", "", "finer steps change pull_off_force by less than 2 %"},
        solution.is_step_converged);
  visit({"residual", "", "the largest of all states"}, solution.residual);
  visit({"state_count", "", "heights that were solved"}, solution.state_count);
  visit({"jumps", "", "places where the curve is not continuous, both ways"}, solution.jumps);
}

}  // namespace mems_stiction
