#pragma once

/// @file
/// Does the answer rest on how the scan was cleaned? The same scan under each cleaning that an
/// operator could choose, beside the configured one, shows how far that choice moves the
/// prediction.
///
///     const std::vector<CleaningRow> rows = cleaningSpread(scan, configuration);
///     std::cout << cleaningTable(rows);

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/settings/figure.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// The prediction under one cleaning. Figures are NaN if it failed, margins also if no device is
/// stated.
struct CleaningRow {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::string cleaning;  ///< "as configured", "plane, without spikes"
  std::string message;   ///< why there is no prediction; empty if there is one
  bool is_reasonable =
      false;  ///< counts for the spread; the others are of scans that are tilted and were left so
  Status status = Status::kNoEquilibrium;
  double rms_height = kUnknown;                 ///< [m]
  double pull_off_force = kUnknown;             ///< [N]
  double contact_area = kUnknown;               ///< [m^2]
  double apparent_work_of_adhesion = kUnknown;  ///< of the contacts [J/m^2]
  int asperity_count = 0;
  double margin = kUnknown;        ///< [-]
  double margin_lower = kUnknown;  ///< 2.5 % quantile [-]
  double margin_upper = kUnknown;  ///< 97.5 % quantile [-]
  Sticks sticks = Sticks::kUnknown;
};

/// How far the cleanings lie apart, of the rows that count.
struct CleaningSpread {
  int count = 0;                                   ///< rows that count
  double pull_off_factor = CleaningRow::kUnknown;  ///< largest over smallest pull-off force [-]
  double margin_factor = CleaningRow::kUnknown;    ///< largest over smallest margin [-]
  double margin_lower =
      CleaningRow::kUnknown;  ///< the smallest lower end of an interval: 95 % with the cleaning [-]
  double margin_upper = CleaningRow::kUnknown;  ///< the largest upper end [-]
};

/// Calls visit(Figure, value) for each figure of a row.
template <typename Row, typename Visitor>
void visitCleaningFields(Row& row, Visitor&& visit) {
  visit({"cleaning"}, row.cleaning);
  visit({"message"}, row.message);
  visit({"is_reasonable"}, row.is_reasonable);
  visit({"status"}, row.status);
  visit({"rms_height", "m"}, row.rms_height);
  visit({"pull_off_force", "N"}, row.pull_off_force);
  visit({"contact_area", "m^2"}, row.contact_area);
  visit({"apparent_work_of_adhesion", "J/m^2"}, row.apparent_work_of_adhesion);
  visit({"asperity_count"}, row.asperity_count);
  visit({"margin"}, row.margin);
  visit({"margin_lower"}, row.margin_lower);
  visit({"margin_upper"}, row.margin_upper);
  visit({"sticks"}, row.sticks);
}

/// Calls visit(Figure, value) for each figure of the spread.
template <typename Visitor>
void visitSpreadFields(const CleaningSpread& spread, Visitor&& visit) {
  visit({"count"}, spread.count);
  visit({"pull_off_factor"}, spread.pull_off_factor);
  visit({"margin_factor"}, spread.margin_factor);
  visit({"margin_lower"}, spread.margin_lower);
  visit({"margin_upper"}, spread.margin_upper);
}

/// The scan as configured; then not levelled, less its plane, less its parabola (polynomial of
/// degree 2), and with its rows at one median and less its plane; each of these as it is and with
/// its spikes filled. The other steps are the configured ones. Not levelled counts where levelling
/// by the plane takes less than half of the rms height away.
/// @throw OptionsError if the configuration is out of range
std::vector<CleaningRow> cleaningSpread(const HeightMap& scan, const Configuration& configuration,
                                        const std::optional<DeviceScale>& scale = std::nullopt);

CleaningSpread spreadOf(const std::vector<CleaningRow>& rows);

/// What a verdict on the scan as configured, the first row, takes into account. Figures that a row
/// does not have, or that are 0, do not count.
CleaningReach reachOf(const std::vector<CleaningRow>& rows);

/// The rows as a table of fixed width for people, a line each and sentences about the spread; every
/// line ends in '\n' and begins with `indent`.
std::string cleaningTable(const std::vector<CleaningRow>& rows, const std::string& indent = {});

}  // namespace mems_stiction
