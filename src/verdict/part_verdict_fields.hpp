#pragma once

/// @file
/// The figures of the verdict on a part, as prediction/prediction_fields.hpp has those of the
/// prediction.

#include "mems_stiction/settings/figure.hpp"
#include "verdict/part_verdict.hpp"
#include "verdict/verdict_fields.hpp"

namespace mems_stiction {

/// @param part PooledVerdict, const or not
/// @param visit called with (Figure, value) for each; regime_flags is for the names of its bits
template <typename VerdictType, typename Visitor>
void visitPartVerdictFields(VerdictType& part, Visitor&& visit) {
  visit({"scan_count", "", "scans of this part"}, part.scan_count);
  visit({"counted_scans", "", "of them make a statement: the figures are theirs"},
        part.counted_scans);
  visit({"sticks", "", "no, marginal, yes or unknown"}, part.sticks);
  visit({"reason", "", "of sticks, one sentence"}, part.reason);
  visit({"verdict_by", "", "who has judged the scans that count"}, part.verdict_by);
  visit({"margin", "", "restoring over pull-off force, geometric mean over the scans"},
        part.margin.value);
  visit({"margin_lower", "", "2.5 % quantile of margin"}, part.margin.lower);
  visit({"margin_upper", "", "97.5 % quantile of margin"}, part.margin.upper);
  visit({"margin_spread", "",
         "standard deviation of ln margin between the scans; NaN of fewer than two"},
        part.margin.spread);
  visit({"margin_place_spread", "", "what the number of contacts explains of the spread of margin"},
        part.margin.place_spread);
  visit({"worst_margin", "", "lowest margin of one scan"}, part.margin.worst);
  visit({"worst_margin_scan", "", "its name"}, part.margin.worst_scan);
  visit({"peel_number", "", "of the beam, geometric mean over the scans"}, part.peel_number.value);
  visit({"peel_number_lower", "", "2.5 % quantile of peel_number"}, part.peel_number.lower);
  visit({"peel_number_upper", "", "97.5 % quantile of peel_number"}, part.peel_number.upper);
  visit({"peel_number_spread", "",
         "standard deviation of ln peel_number between the scans; NaN of fewer than two"},
        part.peel_number.spread);
  visit({"peel_number_place_spread", "",
         "what the number of contacts explains of the spread of peel_number"},
        part.peel_number.place_spread);
  visit({"worst_peel_number", "", "lowest peel_number of one scan"}, part.peel_number.worst);
  visit({"worst_peel_number_scan", "", "its name"}, part.peel_number.worst_scan);
  visit({"regime_flags", "", "of any of the scans"}, part.regime_flags);
  visit({"restoring_force", "N", "of the device's spring, where the device's own force judges"},
        part.restoring_force);
  visit({"device_pull_off_force", "N", "of the whole device, found from all scans together"},
        part.device_pull_off_force);
  visit({"device_pull_off_force_lower", "N", "2.5 % quantile of device_pull_off_force"},
        part.device_pull_off_force_lower);
  visit({"device_pull_off_force_upper", "N", "97.5 % quantile of device_pull_off_force"},
        part.device_pull_off_force_upper);
  visit({"governed_by", "",
         "force or peeling: which of margin and peel number decides whether a beam sticks; empty "
         "where one is all there is"},
        part.governed_by);
}

}  // namespace mems_stiction
