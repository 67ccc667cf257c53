#pragma once

/// @file
/// The one list of what a verdict says, with the field names of the message and the units.

namespace mems_stiction {

/// @param verdict Verdict, const or not
/// @param visit called with (name, value, unit) for each figure
template <typename VerdictType, typename Visitor>
void visitVerdictFields(VerdictType& verdict, Visitor&& visit) {
  visit("sticks", verdict.sticks, "");
  visit("reason", verdict.reason, "");
  visit("restoring_force", verdict.restoring_force, "N");
  visit("device_pull_off_force", verdict.device_pull_off_force, "N");
  visit("margin", verdict.margin, "");
  visit("margin_lower", verdict.margin_lower, "");
  visit("margin_upper", verdict.margin_upper, "");
  visit("margin_uncertainty", verdict.margin_uncertainty, "");
  visit("margin_transition", verdict.margin_transition, "");
  visit("apparent_work_of_adhesion", verdict.apparent_work_of_adhesion, "J/m^2");
  visit("peel_number", verdict.peel_number, "");
  visit("peel_number_lower", verdict.peel_number_lower, "");
  visit("peel_number_upper", verdict.peel_number_upper, "");
  visit("detachment_length", verdict.detachment_length, "m");
  visit("unstuck_length", verdict.unstuck_length, "m");
  visit("pull_in_voltage", verdict.pull_in_voltage, "V");
  visit("regime_flags", verdict.regime_flags, "");
}

}  // namespace mems_stiction
