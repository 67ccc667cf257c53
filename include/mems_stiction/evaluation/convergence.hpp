#pragma once

/// @file
/// Would a finer scan say something else? Predicting the same scan on fewer pixels shows what still
/// moves.
///
/// A scan is made coarser by the mean over blocks of pixels, as an instrument with larger pixels
/// would see it. What full resolution still changes against half of it is a fair guess of what
/// twice as many pixels would change.
///
///     const double fine = model.predict(scan).pull_off_force;
///     const double coarse = model.predict(decimated(scan, 2)).pull_off_force;
///     if (coarse > 1.3 * fine) report("finer pixels are needed");

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {

/// The prediction at one resolution.
struct ConvergenceRow {
  int decimation = 1;  ///< 1 full, 2 half, 4 a quarter of the resolution
  int rows = 0, cols = 0;
  double pitch_x = 0.0, pitch_y = 0.0;  ///< [m]
  Status status = Status::kNoEquilibrium;
  double pull_off_force = 0.0;    ///< [N]
  double contact_area = 0.0;      ///< [m^2]
  double contact_area_jkr = 0.0;  ///< [m^2]
  int asperity_count = 0;
  double median_contact_pixels = 0.0;  ///< of this resolution [-]
  double pull_off_force_ratio = 1.0;   ///< to that of full resolution [-]
  double contact_area_ratio = 1.0;     ///< to that of full resolution [-]
};

/// Calls visit(Figure, value) for each figure of a row.
template <typename Row, typename Visitor>
void visitConvergenceFields(Row& row, Visitor&& visit) {
  visit({"decimation"}, row.decimation);
  visit({"rows"}, row.rows);
  visit({"cols"}, row.cols);
  visit({"pitch_x", "m"}, row.pitch_x);
  visit({"pitch_y", "m"}, row.pitch_y);
  visit({"status"}, row.status);
  visit({"pull_off_force", "N"}, row.pull_off_force);
  visit({"contact_area", "m^2"}, row.contact_area);
  visit({"contact_area_jkr", "m^2"}, row.contact_area_jkr);
  visit({"asperity_count"}, row.asperity_count);
  visit({"median_contact_pixels"}, row.median_contact_pixels);
  visit({"pull_off_force_ratio"}, row.pull_off_force_ratio);
  visit({"contact_area_ratio"}, row.contact_area_ratio);
}

/// Means over blocks of factor x factor pixels: rows/factor x cols/factor, CV_64FC1, metres,
/// pitches factor times as large. A block with fewer than half of its pixels valid is invalid. Rows
/// and columns beyond the last whole block are left out.
/// @throw SurfaceError if there is no whole block.
HeightMap decimated(const HeightMap& surface, int factor);

/// The rows as a table of fixed width for people, a line each and a sentence about what moves;
/// every line ends in '\n' and begins with `indent`.
std::string convergenceTable(const std::vector<ConvergenceRow>& rows,
                             const std::string& indent = {});

}  // namespace mems_stiction
