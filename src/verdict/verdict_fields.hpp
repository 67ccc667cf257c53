#pragma once

/// @file
/// The figures of a verdict, as prediction/prediction_fields.hpp has those of the prediction.

#include "mems_stiction/settings/figure.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// sticksText(), as the tables' other enumerations have it.
inline const char* word(Sticks sticks) { return sticksText(sticks); }

/// @param verdict Verdict, const or not
/// @param visit called with (Figure, value) for each
template <typename VerdictType, typename Visitor>
void visitVerdictFields(VerdictType& verdict, Visitor&& visit) {
  visit({"sticks", "", "no, marginal, yes or unknown"}, verdict.sticks);
  visit({"reason", "", "of sticks, one sentence"}, verdict.reason);
  visit({"restoring_force", "N", "of the device's spring"}, verdict.restoring_force);
  visit({"device_pull_off_force", "N", "of the whole device"}, verdict.device_pull_off_force);
  visit({"margin", "",
         "restoring over pull-off force: above 1 the spring wins; infinite without adhesion"},
        verdict.margin);
  visit({"margin_lower", "", "2.5 % quantile of margin"}, verdict.margin_lower);
  visit({"margin_upper", "", "97.5 % quantile of margin"}, verdict.margin_upper);
  visit({"margin_uncertainty", "", "half of the central 68 % interval of margin"},
        verdict.margin_uncertainty);
  visit({"margin_transition", "", "margin with the prefactors of the JKR-DMT transition"},
        verdict.margin_transition);
  visit({"device_apparent_work_of_adhesion", "J/m^2",
         "of the device's interface, per nominal area, which beams peel"},
        verdict.device_apparent_work_of_adhesion);
  visit({"peel_number", "", "of the beam: above 1 it comes off (de Boer and Michalske 1999)"},
        verdict.peel_number);
  visit({"peel_number_lower", "", "2.5 % quantile of peel_number"}, verdict.peel_number_lower);
  visit({"peel_number_upper", "", "97.5 % quantile of peel_number"}, verdict.peel_number_upper);
  visit({"detachment_length", "m",
         "longest beam that comes off by itself (Mastrangelo and Hsu 1993)"},
        verdict.detachment_length);
  visit({"unstuck_length", "m", "free arm of the beam while it is stuck"}, verdict.unstuck_length);
  visit({"pull_in_voltage", "V", "at which the electrodes close"}, verdict.pull_in_voltage);
  visit({"regime_flags", "", "where the model leaves its range: bits, 0 when all is well"},
        verdict.regime_flags);
  visit({"device_pull_off_force_lower", "N", "2.5 % quantile of device_pull_off_force"},
        verdict.device_pull_off_force_lower);
  visit({"device_pull_off_force_upper", "N", "97.5 % quantile of device_pull_off_force"},
        verdict.device_pull_off_force_upper);
  visit({"governed_by", "",
         "force or peeling: which of margin and peel number decides whether a beam sticks; empty "
         "where one "
         "is all there is"},
        verdict.governed_by);
}

}  // namespace mems_stiction
