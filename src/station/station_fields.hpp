#pragma once

/// @file
/// The figures of load sweeps and contact cycles, as prediction/prediction_fields.hpp has those of
/// the prediction.

#include "mems_stiction/settings/figure.hpp"
#include "station/contact_cycles.hpp"
#include "station/load_sweep.hpp"

namespace mems_stiction {

/// @param row of a sweep @param visit called with (Figure, value) for each
template <typename Visitor>
void visitSweepFields(const LoadSweepRow& row, Visitor&& visit) {
  visit({"direction", "", "0 up, 1 down"}, row.direction);
  visit({"voltage", "V"}, row.voltage);
  visit({"mechanical_load", "N", "on the scanned area"}, row.mechanical_load);
  visit({"status", "", "0 equilibrium, 1 bonded, 2 none"}, row.status);
  visit({"is_open", "", "the device has come off on the way down"}, row.is_open);
  visit({"pull_off_force", "N"}, row.pull_off_force);
  visit({"van_der_waals_force", "N"}, row.van_der_waals_force);
  visit({"electrostatic_force", "N"}, row.electrostatic_force);
  visit({"normal_load", "N"}, row.normal_load);
  visit({"contact_area", "m^2", "real; paper, printed: of the cells in contact"}, row.contact_area);
  visit({"contact_area_jkr", "m^2", "sum of the JKR contacts"}, row.contact_area_jkr);
  visit({"contact_fraction"}, row.contact_fraction);
  visit({"asperity_count", "", "contacts"}, row.asperity_count);
  visit({"approach", "m"}, row.approach);
  visit({"sticks", "", "once the load is taken away: 0 no, 1 marginal, 2 yes, 3 unknown"},
        row.sticks);
  visit({"margin", "", "once the load is taken away"}, row.margin);
  visit({"margin_lower", "", "2.5 % quantile"}, row.margin_lower);
  visit({"holding_margin", "", "while the load acts: restoring force over all that holds"},
        row.holding_margin);
  visit({"margin_upper", "", "97.5 % quantile"}, row.margin_upper);
  visit({"pull_off_force_lower", "N", "2.5 % quantile; NaN without a list of contacts"},
        row.pull_off_interval.lower);
  visit({"pull_off_force_upper", "N", "97.5 % quantile; NaN without a list of contacts"},
        row.pull_off_interval.upper);
  visit({"lands", "",
         "the voltage alone closes the device, or still holds it closed: 0 no, 1 yes, 2 unknown"},
        row.lands);
  visit({"peel_number", "", "of the beam, once the load is taken away"}, row.peel_number);
  visit({"peel_number_lower", "", "2.5 % quantile"}, row.peel_number_lower);
  visit({"peel_number_upper", "", "97.5 % quantile"}, row.peel_number_upper);
  visit({"is_peeled", "", "the peel number decides, not the margin"}, row.is_peeled);
  visit({"is_lower_bound", "", "pull_off_force is a lower bound"}, row.is_lower_bound);
}

/// @param summary of one mechanical load @param visit called with (Figure, value) for each
template <typename Visitor>
void visitSummaryFields(const LoadSweepSummary& summary, Visitor&& visit) {
  visit({"mechanical_load", "N", "on the scanned area"}, summary.mechanical_load);
  visit({"highest_releasing_voltage", "V", "margin at least 1 up to here"},
        summary.highest_releasing_voltage);
  visit({"highest_safe_voltage", "V", "the verdict is no at each voltage up to here"},
        summary.highest_safe_voltage);
  visit({"lowest_sticking_voltage", "V", "the first with a margin below 1"},
        summary.lowest_sticking_voltage);
  visit({"lowest_safe_voltage", "V", "the first with the verdict no"}, summary.lowest_safe_voltage);
  visit({"opening_voltage", "V", "the highest at which the device opens on the way down"},
        summary.opening_voltage);
}

/// @param cycle one contact @param visit called with (Figure, value) for each
template <typename Visitor>
void visitCycleFields(const ContactCycle& cycle, Visitor&& visit) {
  visit({"cycle", "", "from 1"}, cycle.cycle);
  visit({"status", "", "0 equilibrium, 1 bonded, 2 none"}, cycle.status);
  visit({"pull_off_force", "N"}, cycle.pull_off_force);
  visit({"van_der_waals_force", "N"}, cycle.van_der_waals_force);
  visit({"contact_area", "m^2", "real; paper, printed: of the cells in contact"},
        cycle.contact_area);
  visit({"contact_area_jkr", "m^2", "sum of the JKR contacts"}, cycle.contact_area_jkr);
  visit({"contact_fraction"}, cycle.contact_fraction);
  visit({"asperity_count", "", "contacts"}, cycle.asperity_count);
  visit({"plastic_count", "", "of them fully plastic"}, cycle.plastic_count);
  visit({"rms_height", "m", "of the scanned surface after the contact"}, cycle.rms_height);
  visit({"largest_change", "m", "of either surface's height in this contact, at any pixel"},
        cycle.largest_change);
  visit({"sticks", "", "0 no, 1 marginal, 2 yes, 3 unknown"}, cycle.sticks);
  visit({"margin"}, cycle.margin);
  visit({"margin_lower", "", "2.5 % quantile"}, cycle.margin_lower);
  visit({"margin_upper", "", "97.5 % quantile"}, cycle.margin_upper);
  visit({"pull_off_force_lower", "N", "2.5 % quantile; NaN without a list of contacts"},
        cycle.pull_off_interval.lower);
  visit({"pull_off_force_upper", "N", "97.5 % quantile; NaN without a list of contacts"},
        cycle.pull_off_interval.upper);
  visit({"peel_number", "", "of the beam"}, cycle.peel_number);
  visit({"peel_number_lower", "", "2.5 % quantile"}, cycle.peel_number_lower);
  visit({"peel_number_upper", "", "97.5 % quantile"}, cycle.peel_number_upper);
  visit({"is_peeled", "", "the peel number decides, not the margin"}, cycle.is_peeled);
  visit({"is_lower_bound", "", "pull_off_force is a lower bound"}, cycle.is_lower_bound);
}

}  // namespace mems_stiction
