#pragma once

/// @file
/// Up to which voltage does the device still come off?
///
/// For each mechanical load, the voltage goes up through the grid and down again, on surfaces that
/// start as given:
///
///     up    the contact is made under this load (remaining_contact.hpp: the equilibrium of the
///           larger load contains those of the smaller ones). Each row's margin is the device's
///           when the load is then taken away (verdict.hpp).
///     down  the contact made under the highest voltage stays, its elastic part shrinking with the
///           load, until the spring overcomes pull-off force, field and mechanical load together;
///           from there on the device is open. The median of the margin opens it, so the rows
///           of the open device have the word of the contact that opened: marginal where the
///           interval of the margin leaves open whether the device comes off.
///
/// So the same voltage has two rows, and between them lies the hysteresis. Approach and contact
/// area grow with every row upward; the pull-off force grows too, but for F_w, which moves with the
/// gaps just beyond the contacts' edges. What holds a closed device against its spring:
///
///     pull-off force of the device + F_m per area of the frame on the contact area + field: on
///     device/electrode_area across the closed electrodes (electrode gap - travel + mean gap), or,
///     when no electrode is stated, the scan's F_e scaled to the contact area
///
/// A beam alone is held by shares of what opens it, which add up to 1 over its holding margin:
///
///     1/margin, or 1/peel number where it is peeled                         verdict.hpp
///     F_m per area of the frame on the contact area, over the beam's force  beam_adhesion.hpp
///     the field's force over the beam's, or its work over the beam's where it is peeled
///             beam_field.hpp
///
/// Without an electrode its field is the scan's F_e scaled to the contact area. A share that its
/// settings do not give (a load on a beam without width or contact area, a voltage without either
/// electrode or contact area) leaves the holding margin unknown.
///
/// A row upward does not ask for its verdict whether the voltage alone would close the device: a
/// shock or a test load may. That is said beside: the device lands from the pull-in voltage on, and
/// stays down on the way back until it opens.
///
///     LoadSweepRequest request;
///     request.voltages = {0, 5, 10, 20};
///     request.mechanical_loads = {0};
///     const LoadSweepResult result = sweepLoads(options, scan, request, device, uncertainty,
///         RunControl());

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "station/measured_scan.hpp"
#include "station/run_control.hpp"
#include "verdict/margin_uncertainty.hpp"

namespace mems_stiction {

/// The grid of loads.
struct LoadSweepRequest {
  std::vector<double> voltages;          ///< [V], >= 0, ascending
  std::vector<double> mechanical_loads;  ///< on the scanned area [N], ascending

  /// One line per violated constraint, those of the model's load settings included; empty when all
  /// is well.
  std::vector<std::string> validate(const Options& options) const;

  /// Loads under which the device's own force is found: all pairs if they are few, else some of
  /// them, with the largest of both; none of a request that is refused.
  std::vector<LoadOptions> loadsOfDevice(const Options& options) const;
};

enum class SweepDirection : std::uint8_t { kUp = 0, kDown = 1 };

/// "up", "down".
const char* word(SweepDirection direction);

/// Whether the field of the voltage alone brings the device down, or has and still holds it. The
/// values are those of the message.
enum class Lands : std::uint8_t { kNo = 0, kYes = 1, kUnknown = 2 };

/// "no", "yes", "unknown".
const char* word(Lands lands);

/// One load of the sweep. Forces and areas are of the scan; they are 0 once the device is open.
/// NaN: device not stated.
struct LoadSweepRow {
  double voltage = 0.0;          ///< [V]
  double mechanical_load = 0.0;  ///< [N]
  SweepDirection direction = SweepDirection::kUp;
  Status status = Status::kNoEquilibrium;  ///< of the search that made the contact
  bool is_lower_bound =
      false;             ///< the pull-off force: the search ended before contacts stopped growing
  bool is_open = false;  ///< the device has come off on the way down
  double pull_off_force = 0.0;       ///< [N]
  double van_der_waals_force = 0.0;  ///< [N]
  double electrostatic_force = 0.0;  ///< [N]
  double normal_load = 0.0;          ///< [N]
  double contact_area = 0.0;         ///< real; of the paper that of the cells in contact [m^2]
  double contact_area_jkr = 0.0;     ///< [m^2]
  double contact_fraction = 0.0;     ///< [-]
  int asperity_count = 0;
  double approach = 0.0;                      ///< [m]
  Sticks sticks = Sticks::kUnknown;           ///< once the load is taken away
  double margin = Verdict::kNotStated;        ///< once the load is taken away [-]
  double margin_lower = Verdict::kNotStated;  ///< 2.5 % quantile [-]
  double holding_margin =
      Verdict::kNotStated;  ///< while the load acts: restoring force over all that holds [-]
  double margin_upper = Verdict::kNotStated;  ///< 97.5 % quantile [-]
  ForceInterval pull_off_interval;  ///< of the pull-off force; NaN without a list of contacts
  double peel_number = Verdict::kNotStated;        ///< of the beam, once the load is taken away [-]
  double peel_number_lower = Verdict::kNotStated;  ///< 2.5 % quantile [-]
  double peel_number_upper = Verdict::kNotStated;  ///< 97.5 % quantile [-]
  bool is_peeled = false;  ///< the peel number decides, not the margin (isPeeled())
  Lands lands =
      Lands::kUnknown;  ///< kUnknown: the pull-in voltage is not known, or what holds is not

  /// The one of margin and peel number that decides [-].
  double ratio() const { return is_peeled ? peel_number : margin; }
};

/// What one loop of the voltage says. NaN: there is none on the grid.
struct LoadSweepSummary {
  double mechanical_load = 0.0;  ///< [N]
  double highest_releasing_voltage =
      Verdict::kNotStated;  ///< margin (of a beam that is peeled its peel number) >= 1 up to here,
                            ///< in equilibrium [V]
  double highest_safe_voltage =
      Verdict::kNotStated;  ///< the verdict is "no" at each voltage up to here [V]
  double lowest_sticking_voltage = Verdict::kNotStated;  ///< the first with a margin below 1 [V]
  double opening_voltage =
      Verdict::kNotStated;  ///< the highest at which the device opens on the way down [V]
  double lowest_safe_voltage =
      Verdict::kNotStated;  ///< the first with the verdict "no", whatever lower ones have [V]
};

/// Of the rows of one mechanical load [N]: as their verdicts say.
LoadSweepSummary summaryOf(double mechanical_load, const std::vector<LoadSweepRow>& rows);

/// The curve, and what it says.
struct LoadSweepResult {
  std::vector<LoadSweepRow> rows;                ///< per mechanical load: upward, then downward
  std::vector<LoadSweepSummary> summaries;       ///< one per mechanical load that was finished
  double pull_in_voltage = Verdict::kNotStated;  ///< [V]
  std::string pull_in_reason;  ///< which settings it lacks; empty when it is known
  std::string why_no_margin;   ///< of the first row: the reason of its verdict, where that has
                               ///< neither margin nor peel number
  bool is_complete = false;    ///< false: cancelled
};

/// - @p scales the device's own figures beside those of this frame; a row takes those of the least
/// load that is no less than its own. Without them the verdicts have the frame's
/// - @p scan behind the surfaces; nothing: they are on the pixels that were measured
/// @throw OptionsError for a request or options out of range, before any work; SurfaceError as
/// AdhesionModel.
LoadSweepResult sweepLoads(const Options& options, const SurfacePair& surfaces,
                           const LoadSweepRequest& request, const DeviceOptions& device,
                           const UncertaintyOptions& uncertainty, const RunControl& control,
                           const std::vector<LoadedScale>& scales = {},
                           const std::optional<MeasuredScan>& scan = std::nullopt);

}  // namespace mems_stiction
