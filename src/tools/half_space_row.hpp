#pragma once

/// What the half-space has to say for one row of a table, and in full for a report.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "batch_rows.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "scan_row.hpp"

namespace mems_stiction {

/// A solution, as far as it came, and why there is none.
struct HalfSpaceAnswer {
  bool is_called = false;                   ///< the scan was to be solved
  std::optional<SolvedHalfSpace> solution;  ///< nothing if it could not be asked
  std::string message;                      ///< empty if it is solved
};

/// half_space_message, verdict_by of a verdict, then the figures by the names of the record's
/// half_space with half_space_ before them; those that were not reached are NaN, and without a
/// solution there are none. No wall time: the same scan gives the same row.
RowFields halfSpaceFields(const HalfSpaceAnswer& answer, const std::optional<Verdict>& verdict);

/// Every such field in order, as it is without a value.
RowFields halfSpaceSample(bool with_verdict);

/// The unit of every such column that has one.
std::map<std::string, std::string> halfSpaceColumnUnits();

/// half_space_processing_time [s], and half_space_curve by columns.
RowFields halfSpaceExtras(const SolvedHalfSpace& solution);

/// half_space_pressure, half_space_gap, half_space_deformed and half_space_counter_deformed, as far
/// as there are.
NamedMaps halfSpaceMaps(const SolvedHalfSpace& solution);

}  // namespace mems_stiction
