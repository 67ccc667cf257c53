#pragma once

/// @file
/// The lists that a device's force has beside its figures (device_force_fields.hpp).

#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {

/// @param realisation Realisation, const or not
/// @param visit called with (Figure, value) for each
template <typename RealisationType, typename Visitor>
void visitRealisationFields(RealisationType& realisation, Visitor&& visit) {
  visit({"pull_off_force", "N", "of the device"}, realisation.pull_off_force);
  visit({"apparent_work_of_adhesion", "J/m^2", "per nominal area"},
        realisation.apparent_work_of_adhesion);
  visit({"contacts", "", "places that hold at the pull-off"}, realisation.contacts);
  visit({"separation_at_rest", "m", "mean gap"}, realisation.separation_at_rest);
}

/// @param part PartOfScan, const or not
/// @param visit called with (Figure, value) for each
template <typename PartType, typename Visitor>
void visitPartOfScanFields(PartType& part, Visitor&& visit) {
  visit({"area", "m^2", "of the part of a scan"}, part.area);
  visit({"pull_off_force", "N", "of the part, as it was predicted"}, part.pull_off_force);
}

/// @param band BandOfWaves, const or not
/// @param visit called with (Figure, value) for each
template <typename BandType, typename Visitor>
void visitBandFields(BandType& band, Visitor&& visit) {
  visit({"wavelength", "m", "of the band"}, band.wavelength);
  visit({"density", "m^4", "power spectral density, averaged over directions"}, band.density);
  visit({"density_lower", "m^4", "2.5 % quantile"}, band.density_lower);
  visit({"density_upper", "m^4", "97.5 % quantile"}, band.density_upper);
  visit({"rms_height", "m", "of all waves shorter than this, with those of the band"},
        band.rms_height);
  visit({"rms_slope", "", "of all waves longer than this, with those of the band"}, band.rms_slope);
  visit({"rms_curvature", "1/m", "of all waves longer than this, with those of the band"},
        band.rms_curvature);
  visit({"is_measured", "", "false: continued beyond what the scans show"}, band.is_measured);
}

}  // namespace mems_stiction
