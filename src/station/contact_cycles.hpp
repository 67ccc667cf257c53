#pragma once

/// @file
/// After how many contacts does the device fail?
///
/// The surfaces meet N times under the same load, each time as the last contact left them: what has
/// flowed stays flat (deformation/modified_topography.hpp), what was elastic has come back.
/// Flattened summits conform, so that contact area and adhesion grow until the surfaces carry the
/// load without flow (shakedown) and nothing changes any more. Assumptions: both surfaces meet in
/// the same place each time, to the pixel; no wear, no material transfer, no hardening; contacts
/// open fully in between.
///
///     const ContactCyclesResult result = cycleContacts(options, scan, 100, device, uncertainty,
///         RunControl());

#include <optional>
#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "station/measured_scan.hpp"
#include "station/run_control.hpp"
#include "verdict/margin_uncertainty.hpp"

namespace mems_stiction {

/// One contact; forces and areas are of the scan.
struct ContactCycle {
  int cycle = 0;  ///< from 1
  Status status = Status::kNoEquilibrium;
  bool is_lower_bound =
      false;  ///< the pull-off force: the search ended before contacts stopped growing
  double pull_off_force = 0.0;       ///< [N]
  double van_der_waals_force = 0.0;  ///< [N]
  double contact_area = 0.0;         ///< real; of the paper that of the cells in contact [m^2]
  double contact_area_jkr = 0.0;     ///< [m^2]
  double contact_fraction = 0.0;     ///< [-]
  int asperity_count = 0;
  int plastic_count = 0;        ///< contacts that are fully plastic
  double rms_height = 0.0;      ///< Sq of the lower surface after the contact [m]
  double largest_change = 0.0;  ///< of either surface's height in this contact, at any pixel [m]
  Sticks sticks = Sticks::kUnknown;
  double margin = Verdict::kNotStated;        ///< [-]
  double margin_lower = Verdict::kNotStated;  ///< 2.5 % quantile [-]
  double margin_upper = Verdict::kNotStated;  ///< 97.5 % quantile [-]
  ForceInterval pull_off_interval;  ///< of the pull-off force; NaN without a list of contacts
  double peel_number = Verdict::kNotStated;        ///< of the beam [-]
  double peel_number_lower = Verdict::kNotStated;  ///< 2.5 % quantile [-]
  double peel_number_upper = Verdict::kNotStated;  ///< 97.5 % quantile [-]
  bool is_peeled = false;  ///< the peel number decides, not the margin (isPeeled())

  /// The one of margin and peel number that decides [-].
  double ratio() const { return is_peeled ? peel_number : margin; }
};

/// What the contacts said, in order.
struct ContactCyclesResult {
  std::vector<ContactCycle> cycles;
  int first_sticking_cycle =
      0;  ///< the first whose verdict is "yes"; 0 = none, or neither a spring nor a beam stated
  std::string why_no_margin;  ///< of the first contact: the reason of its verdict, where that has
                              ///< neither margin nor peel number
  SurfacePair
      surfaces;  ///< after the last contact, the upper one in its own z; a plane starts from 0
  bool is_complete = false;  ///< false: cancelled
};

/// - @p count of contacts, within [1, 1000000]
/// - @p scales the device's own figures beside those of this frame, the first of them; without them
/// the verdicts have the frame's
/// - @p scan behind the surfaces; nothing: they are on the pixels that were measured
/// @throw OptionsError for a count or options out of range, before any work; SurfaceError as
/// AdhesionModel.
ContactCyclesResult cycleContacts(const Options& options, const SurfacePair& surfaces, int count,
                                  const DeviceOptions& device,
                                  const UncertaintyOptions& uncertainty, const RunControl& control,
                                  const std::vector<LoadedScale>& scales = {},
                                  const std::optional<MeasuredScan>& scan = std::nullopt);

}  // namespace mems_stiction
