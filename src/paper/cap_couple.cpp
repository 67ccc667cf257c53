#include "paper/cap_couple.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

/// Caps lower than this share of the patch's largest interference do not describe it.
constexpr double kLowestHeightShare = 0.1;
constexpr double kFewestEdgesOfPlane = 4.0;
/// Relative determinant below which the boundary edges count as lying on one line.
constexpr double kSingular = 1e-9;

/// A quantity on a base plane at the centre, and its slopes [per half pixel].
struct Plane {
  double at_centre;
  double slope_x;
  double slope_y;
};

/// Least-squares planes through the boundary edges, all from one set of sums. Planes of a patch
/// without edges are level and have no height (NaN).
class BasePlanes {
 public:
  /// Coordinates are moved to the centre, exactly: no digits are lost to the patch's place in the
  /// frame.
  BasePlanes(const BoundarySums& edges, const GridCell& centre)
      : centre_x_(2.0 * centre.col), centre_y_(2.0 * centre.row) {
    const double count = edges.count;
    const double x = edges.x - count * centre_x_;
    const double y = edges.y - count * centre_y_;
    const double xx = edges.xx - 2.0 * centre_x_ * edges.x + count * centre_x_ * centre_x_;
    const double yy = edges.yy - 2.0 * centre_y_ * edges.y + count * centre_y_ * centre_y_;
    const double xy =
        edges.xy - centre_x_ * edges.y - centre_y_ * edges.x + count * centre_x_ * centre_y_;
    inverse_count_ = count > 0.0 ? 1.0 / count : std::numeric_limits<double>::quiet_NaN();
    mean_x_ = x * inverse_count_;
    mean_y_ = y * inverse_count_;
    var_x_ = xx - x * mean_x_;
    var_y_ = yy - y * mean_y_;
    cov_ = xy - x * mean_y_;
    const double determinant = var_x_ * var_y_ - cov_ * cov_;
    is_level_ = count < kFewestEdgesOfPlane || determinant <= kSingular * var_x_ * var_y_;
    inverse_determinant_ = 1.0 / determinant;
  }

  /// From the sums over the edges of a quantity and of its products with x and y.
  Plane fit(double sum, double x_sum, double y_sum) const {
    Plane plane{sum * inverse_count_, 0.0, 0.0};
    if (is_level_) return plane;
    const double x_moment = x_sum - centre_x_ * sum - mean_x_ * sum;
    const double y_moment = y_sum - centre_y_ * sum - mean_y_ * sum;
    plane.slope_x = (var_y_ * x_moment - cov_ * y_moment) * inverse_determinant_;
    plane.slope_y = (var_x_ * y_moment - cov_ * x_moment) * inverse_determinant_;
    plane.at_centre -= plane.slope_x * mean_x_ + plane.slope_y * mean_y_;
    return plane;
  }

 private:
  double centre_x_, centre_y_;
  double inverse_count_;
  double mean_x_, mean_y_;
  double var_x_, var_y_, cov_;
  double inverse_determinant_;
  bool is_level_;
};

/// How far the outline at `level` lies beyond the centre of an extreme cell, towards its neighbour
/// outside [cells], in [0, 1]; where there is none, the outline is the cell's edge.
double outlineBeyond(const ExtremeCell& extreme, double level) {
  constexpr double kCellEdge = 0.5;
  const double rise = extreme.outside - extreme.gap;
  if (!(rise > 0.0 && rise < GapField::kInvalidGap)) return kCellEdge;
  return std::clamp((level - extreme.gap) / rise, 0.0, 1.0);
}

/// rc, from the box around the patch's outline at `level`.
double capRadius(const ContactPatch& patch, const GapField& field, double level) {
  const auto beyond = [&](Side side) { return outlineBeyond(patch.extreme[side], level); };
  const double width = patch.max_col - patch.min_col + beyond(kLeft) + beyond(kRight);
  const double length = patch.max_row - patch.min_row + beyond(kTop) + beyond(kBottom);
  return (width * field.pitchX() + length * field.pitchY()) / 4.0;
}

/// Of the circle through the rim and the summit of a cap.
double curvature(double cap_radius, double height) {
  return 2.0 * height / (cap_radius * cap_radius + height * height);
}

}  // namespace

PatchCentre boxCentre(const ContactPatch& patch, const GapField& field) {
  const int rows[] = {(patch.min_row + patch.max_row) / 2, (patch.min_row + patch.max_row + 1) / 2};
  const int cols[] = {(patch.min_col + patch.max_col) / 2, (patch.min_col + patch.max_col + 1) / 2};
  PatchCentre centre{field.cellAt(rows[0], cols[0]), GapField::kInvalidGap};
  for (const int row : rows) {
    for (const int col : cols) {
      const GridCell cell = field.cellAt(row, col);
      const double gap = field.gap(cell.index);
      if (comesBefore(gap, cell.index, centre.gap, centre.cell.index)) centre = {cell, gap};
    }
  }
  return centre;
}

PatchCentre deepestCentre(const ContactPatch& patch, const GapField& field) {
  return {field.cellAt(patch.deepest), patch.deepest_gap};
}

CapCouple capCouple(const ContactPatch& patch, const GapField& field, const PatchCentre& centre,
                    double cutoff_distance) {
  const BoundarySums& edges = patch.boundary;
  const BasePlanes planes(edges, centre.cell);
  const Plane gap = planes.fit(edges.gap, edges.x_gap, edges.y_gap);
  // against a plane the lower surface is the gap, turned over
  double lower_height = gap.at_centre - centre.gap;
  double upper_height = 0.0;
  double mid_slope_x = -0.5 * gap.slope_x;
  double mid_slope_y = -0.5 * gap.slope_y;
  if (!field.upperIsFlat()) {
    const Plane lower = planes.fit(edges.lower, edges.x_lower, edges.y_lower);
    const double lower_summit = field.lowerHeight(centre.cell.index);
    lower_height = lower_summit - lower.at_centre;
    upper_height = lower.at_centre + gap.at_centre - (lower_summit + centre.gap);
    mid_slope_x = lower.slope_x + 0.5 * gap.slope_x;
    mid_slope_y = lower.slope_y + 0.5 * gap.slope_y;
  }
  // a summit that is not above its base plane, or has none, is flat
  if (!(lower_height > 0.0)) lower_height = 0.0;
  if (!(upper_height > 0.0)) upper_height = 0.0;
  mid_slope_x *= 2.0 / field.pitchX();
  mid_slope_y *= 2.0 / field.pitchY();

  CapCouple caps;
  caps.centre = centre.cell;
  caps.squared_slope = mid_slope_x * mid_slope_x + mid_slope_y * mid_slope_y;
  caps.cos_tilt = 1.0 / std::sqrt(1.0 + caps.squared_slope);

  const double level = edges.count > 0.0 ? edges.gap / edges.count : patch.latest_gap;
  const double interference = level - patch.deepest_gap;
  caps.cap_radius = capRadius(patch, field, level);
  caps.height = lower_height + upper_height;
  if (caps.height <= kLowestHeightShare * interference || caps.height <= 0.0) {
    caps.height = lower_height = std::max(interference, cutoff_distance);
    upper_height = 0.0;
  }
  double curvatures = curvature(caps.cap_radius, lower_height);
  if (upper_height > 0.0) curvatures += curvature(caps.cap_radius, upper_height);
  caps.composite_radius = 1.0 / curvatures;
  return caps;
}

}  // namespace mems_stiction
