#include "mems_stiction/approach/cap_couple.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/base/lanes.hpp"
#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {
namespace {

/// Caps lower than this share of the patch's largest interference do not describe it.
constexpr double kLowestHeightShare = 0.1;
constexpr double kFewestEdgesOfPlane = 4.0;
/// Relative determinant below which the boundary edges count as lying on one line.
constexpr double kSingular = 1e-9;

/// A quantity on the base plane at the centre, and its slope [per half pixel].
struct PlaneValue {
  double at_centre = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
};

/// Least-squares planes through the boundary edges, all from one set of sums.
class BasePlanes {
 public:
  /// Coordinates are moved to the centre, exactly: no digits are lost to the patch's place in the frame.
  BasePlanes(const BoundarySums& sums, double centre_x, double centre_y)
      : inverse_count_(1.0 / sums.count), centre_x_(centre_x), centre_y_(centre_y) {
    const double x = sums.x - sums.count * centre_x;
    const double y = sums.y - sums.count * centre_y;
    const double xx = sums.xx - 2.0 * centre_x * sums.x + sums.count * centre_x * centre_x;
    const double yy = sums.yy - 2.0 * centre_y * sums.y + sums.count * centre_y * centre_y;
    const double xy = sums.xy - centre_x * sums.y - centre_y * sums.x + sums.count * centre_x * centre_y;
    mean_x_ = x * inverse_count_;
    mean_y_ = y * inverse_count_;
    var_x_ = xx - x * mean_x_;
    var_y_ = yy - y * mean_y_;
    cov_ = xy - x * mean_y_;
    const double determinant = var_x_ * var_y_ - cov_ * cov_;
    is_level_ = sums.count < kFewestEdgesOfPlane || determinant <= kSingular * var_x_ * var_y_;
    inverse_determinant_ = 1.0 / determinant;
  }

  PlaneValue fit(double sum, double x_sum, double y_sum) const {
    PlaneValue plane;
    plane.at_centre = sum * inverse_count_;
    if (is_level_) return plane;
    const double x_moment = x_sum - centre_x_ * sum - mean_x_ * sum;
    const double y_moment = y_sum - centre_y_ * sum - mean_y_ * sum;
    plane.slope_x = (var_y_ * x_moment - cov_ * y_moment) * inverse_determinant_;
    plane.slope_y = (var_x_ * y_moment - cov_ * x_moment) * inverse_determinant_;
    plane.at_centre -= plane.slope_x * mean_x_ + plane.slope_y * mean_y_;
    return plane;
  }

 private:
  double inverse_count_;
  double centre_x_;
  double centre_y_;
  double mean_x_ = 0.0, mean_y_ = 0.0;
  double var_x_ = 0.0, var_y_ = 0.0, cov_ = 0.0;
  double inverse_determinant_ = 0.0;
  bool is_level_ = true;
};

/// How far the outline at `level` lies beyond the centres of the extreme cells, towards their neighbours outside
/// [cells], in [0, 1]; where there is none, the outline is the cell's edge.
MEMS_STICTION_INLINE void outlineBeyond(const ExtremeCells& extreme, double level, Lanes& beyond) {
  constexpr double kCellEdge = 0.5;
  const Lanes zero{};
  const Lanes& gap = extreme.gaps();
  const Lanes& outside = extreme.outside();
  const Lanes rise = outside - gap;
  const Lanes share = (level - gap) / rise;
  const Lanes within = share > 0.0 ? (share < 1.0 ? share : zero + 1.0) : zero;
  beyond = (rise > 0.0) & (rise < GapField::kInvalidGap) ? within : zero + kCellEdge;
}

MEMS_STICTION_INLINE double baseRadius(const ContactPatch& patch, const GapField& field, double level) {
  Lanes beyond;
  outlineBeyond(patch.extreme, level, beyond);
  const double cols = patch.max_col - patch.min_col + beyond[kLeft] + beyond[kRight];
  const double rows = patch.max_row - patch.min_row + beyond[kTop] + beyond[kBottom];
  return (cols * field.pitchX() + rows * field.pitchY()) / 4.0;
}

/// Curvature of the circle through the rim and the summit of a cap.
double capCurvature(double base_radius, double height) {
  return 2.0 * height / (base_radius * base_radius + height * height);
}

}  // namespace

PatchCentre boxCentre(const ContactPatch& patch, const GapField& field) {
  const int first_row = (patch.min_row + patch.max_row) / 2;
  const int last_row = (patch.min_row + patch.max_row + 1) / 2;
  const int first_col = (patch.min_col + patch.max_col) / 2;
  const int last_col = (patch.min_col + patch.max_col + 1) / 2;
  return field.readGaps([&](const auto& gaps) {
    PatchCentre centre{field.cellAt(first_row, first_col), GapField::kInvalidGap};
    for (int row = first_row; row <= last_row; ++row) {
      for (int col = first_col; col <= last_col; ++col) {
        const GridCell cell = field.cellAt(row, col);
        const double gap = gaps[cell.index];
        if (gap < centre.gap) centre = {cell, gap};
      }
    }
    return centre;
  });
}

PatchCentre deepestCentre(const ContactPatch& patch, const GapField& field) {
  return {field.cellAt(patch.deepest), patch.deepest_gap};
}

MEMS_STICTION_VECTORIZED CapCouple capCouple(const ContactPatch& patch, const GapField& field,
                                             const PatchCentre& centre, double smallest_height) {
  CapCouple caps;
  caps.centre = centre.cell;
  const BoundarySums& edges = patch.boundary;
  const bool has_edges = edges.count > 0.0;
  const double level = has_edges ? edges.gap / edges.count : patch.latest_gap;
  caps.base_radius = baseRadius(patch, field, level);

  double lower_height = 0.0;
  double upper_height = 0.0;
  if (has_edges) {
    const BasePlanes planes(edges, 2 * centre.cell.col, 2 * centre.cell.row);
    const PlaneValue gap = planes.fit(edges.gap, edges.x_gap, edges.y_gap);
    double mid_slope_x = -0.5 * gap.slope_x;
    double mid_slope_y = -0.5 * gap.slope_y;
    if (field.upperIsFlat()) {  // the lower surface is the gap, turned over
      lower_height = std::max(0.0, gap.at_centre - centre.gap);
    } else {
      const PlaneValue lower = planes.fit(edges.lower, edges.x_lower, edges.y_lower);
      const double lower_summit = field.lowerHeight(centre.cell.index);
      lower_height = std::max(0.0, lower_summit - lower.at_centre);
      upper_height = std::max(0.0, lower.at_centre + gap.at_centre - (lower_summit + centre.gap));
      mid_slope_x = lower.slope_x + 0.5 * gap.slope_x;
      mid_slope_y = lower.slope_y + 0.5 * gap.slope_y;
    }
    mid_slope_x *= 2.0 / field.pitchX();
    mid_slope_y *= 2.0 / field.pitchY();
    caps.squared_slope = mid_slope_x * mid_slope_x + mid_slope_y * mid_slope_y;
    caps.cos_tilt = 1.0 / std::sqrt(1.0 + caps.squared_slope);
  }

  const double interference = level - patch.deepest_gap;
  caps.height = lower_height + upper_height;
  double curvature = capCurvature(caps.base_radius, lower_height);
  if (upper_height > 0.0) curvature += capCurvature(caps.base_radius, upper_height);
  if (caps.height <= kLowestHeightShare * interference || caps.height <= 0.0) {
    caps.height = std::max(interference, smallest_height);
    curvature = capCurvature(caps.base_radius, caps.height);
  }
  caps.composite_radius = 1.0 / curvature;
  return caps;
}

}  // namespace mems_stiction
