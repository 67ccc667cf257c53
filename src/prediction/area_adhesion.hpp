#pragma once

/// @file
/// The adhesion of an area that is too large to be held as a frame, by its cells
/// (approach/area_cells.hpp): the separation curve of the whole area (doc/separation_curve.md),
/// from the cells that can touch or come in reach, one by one, and from all others by their gaps.
/// On areas that are small enough for both, AdhesionModel says the same.
///
/// The surfaces part by contacts. Whether they would conform is not a matter of the highest cells:
/// flattening ratios of scans tell.
///
///     AreaCells cells(pitch, pitch);
///     for (...) cells.add(row, col, relief_of_tile);
///     const AreaAdhesion found = areaAdhesion(cells, options);
///     if (found.is_enough) use(found.pull_off_force);

#include <limits>
#include <vector>

#include "approach/area_cells.hpp"
#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/prediction/options.hpp"

namespace mems_stiction {

/// Figures are those of the whole area, and NaN unless its cells were enough.
struct AreaAdhesion {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  bool is_enough = true;  ///< false: cells that were not kept come in reach, or those that do have
                          ///< no room in a frame: this is no area that rests on few summits
  bool took_all_cells = false;  ///< that were kept: more might have been taken

  Status status = Status::kNoEquilibrium;
  bool is_bonded_by_load =
      false;               ///< bonded, but without the loads they would have come to rest before
  bool flows = false;      ///< whether contacts may have flowed, as whole contacts
  double area = kUnknown;  ///< of the valid cells [m^2]
  double pull_off_force = kUnknown;             ///< [N]
  double apparent_work_of_adhesion = kUnknown;  ///< [J/m^2]
  Exponents pull_off_exponents;
  Exponents work_exponents;
  double approach = kUnknown;                 ///< at rest, from first touch [m]
  double separation_at_rest = kUnknown;       ///< mean gap of the cells apart at rest [m]
  double contact_area = kUnknown;             ///< real, at rest [m^2]
  double contact_stiffness = kUnknown;        ///< -dF/dD at rest [N/m]
  int contact_count = 0;                      ///< patches at rest
  int pull_off_contact_count = 0;             ///< patches in reach at the pull-off
  double median_composite_radius = kUnknown;  ///< of the contacts at rest [m]
  double median_tabor_parameter = kUnknown;   ///< of one with that radius [-]
  /// The loading branch, then the unloading branch where it is another, as in ContactSolution.
  std::vector<SeparationCurvePoint> curve;
};

/// - @p options of the default formulation; load/mechanical_load presses the whole area [N]
/// @throw OptionsError if the options are out of range, or of another formulation.
/// @throw SurfaceError if the area has no valid cell.
AreaAdhesion areaAdhesion(const AreaCells& cells, const Options& options);

}  // namespace mems_stiction
