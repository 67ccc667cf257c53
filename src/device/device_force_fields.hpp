#pragma once

/// @file
/// The figures of a device's force, as prediction/prediction_fields.hpp has those of the
/// prediction.

#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {

/// @param force DeviceForce, const or not
/// @param visit called with (Figure, value) for each
template <typename DeviceForceType, typename Visitor>
void visitDeviceForceFields(DeviceForceType& force, Visitor&& visit) {
  visit({"pull_off_force", "N", "of the device, median"}, force.pull_off_force);
  visit({"pull_off_force_lower", "N", "2.5 % quantile"}, force.pull_off_force_lower);
  visit({"pull_off_force_upper", "N", "97.5 % quantile"}, force.pull_off_force_upper);
  visit({"apparent_work_of_adhesion", "J/m^2", "per nominal area, median"},
        force.apparent_work_of_adhesion);
  visit({"apparent_work_of_adhesion_lower", "J/m^2", "2.5 % quantile"},
        force.apparent_work_of_adhesion_lower);
  visit({"apparent_work_of_adhesion_upper", "J/m^2", "97.5 % quantile"},
        force.apparent_work_of_adhesion_upper);
  visit({"linear_pull_off_force", "N", "the scans' force by area, for comparison"},
        force.linear_pull_off_force);
  visit({"contacts", "", "places that hold at the pull-off, median"}, force.contacts);
  visit({"separation_at_rest", "m", "mean gap, median"}, force.separation_at_rest);
  visit({"is_conforming", "", "the surfaces bond all over: force and work go with area"},
        force.is_conforming);
  visit({"area", "m^2", "nominal, of all contacts"}, force.area);
  visit({"pitch", "m", "of the made surfaces"}, force.pitch);
  visit({"force_deviation", "", "standard deviation of ln force but for constants and model"},
        force.force_deviation);
}

}  // namespace mems_stiction
