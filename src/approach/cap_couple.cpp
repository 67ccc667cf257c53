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

using FourPatches = CentredPatch[kLanes];

/// Four members of the patches' BoundarySums that follow each other, from `first` on.
MEMS_STICTION_INLINE void loadSums(const FourPatches& patches, double BoundarySums::*first, Lanes& sum0, Lanes& sum1,
                                   Lanes& sum2, Lanes& sum3) {
  load(&(patches[0].patch->boundary.*first), sum0);
  load(&(patches[1].patch->boundary.*first), sum1);
  load(&(patches[2].patch->boundary.*first), sum2);
  load(&(patches[3].patch->boundary.*first), sum3);
  transpose(sum0, sum1, sum2, sum3);
}

/// The sums over the patches' edges that say where their base planes lie and how the gap runs there.
struct EdgeLanes {
  Lanes count, gap;
  Lanes x, x_gap;
  Lanes y, y_gap;
  Lanes xx, yy, xy;

  MEMS_STICTION_INLINE explicit EdgeLanes(const FourPatches& patches) {
    loadSums(patches, &BoundarySums::count, count, gap, x, x_gap);
    loadSums(patches, &BoundarySums::y, y, y_gap, xx, yy);
    fill([&](int i) { return patches[i].patch->boundary.xy; }, xy);
  }
};

/// A quantity on the base planes at the centres, and its slopes [per half pixel].
struct PlaneLanes {
  Lanes at_centre;
  Lanes slope_x;
  Lanes slope_y;
};

/// Least-squares planes through the boundary edges, all from one set of sums. Planes of a patch without edges are level
/// and have no height (NaN).
class BasePlanes {
 public:
  /// Coordinates are moved to the centres, exactly: no digits are lost to a patch's place in the frame.
  MEMS_STICTION_INLINE BasePlanes(const EdgeLanes& sums, const FourPatches& patches) {
    fill([&](int i) { return 2 * patches[i].centre->cell.col; }, centre_x_);
    fill([&](int i) { return 2 * patches[i].centre->cell.row; }, centre_y_);
    const Lanes x = sums.x - sums.count * centre_x_;
    const Lanes y = sums.y - sums.count * centre_y_;
    const Lanes xx = sums.xx - 2.0 * centre_x_ * sums.x + sums.count * centre_x_ * centre_x_;
    const Lanes yy = sums.yy - 2.0 * centre_y_ * sums.y + sums.count * centre_y_ * centre_y_;
    const Lanes xy = sums.xy - centre_x_ * sums.y - centre_y_ * sums.x + sums.count * centre_x_ * centre_y_;
    inverse_count_ = 1.0 / sums.count;
    mean_x_ = x * inverse_count_;
    mean_y_ = y * inverse_count_;
    var_x_ = xx - x * mean_x_;
    var_y_ = yy - y * mean_y_;
    cov_ = xy - x * mean_y_;
    const Lanes determinant = var_x_ * var_y_ - cov_ * cov_;
    is_level_ = (sums.count < kFewestEdgesOfPlane) | (determinant <= kSingular * var_x_ * var_y_);
    inverse_determinant_ = 1.0 / determinant;
  }

  MEMS_STICTION_INLINE void fit(const Lanes& sum, const Lanes& x_sum, const Lanes& y_sum, PlaneLanes& plane) const {
    const Lanes zero{};
    const Lanes x_moment = x_sum - centre_x_ * sum - mean_x_ * sum;
    const Lanes y_moment = y_sum - centre_y_ * sum - mean_y_ * sum;
    plane.slope_x = is_level_ ? zero : (var_y_ * x_moment - cov_ * y_moment) * inverse_determinant_;
    plane.slope_y = is_level_ ? zero : (var_x_ * y_moment - cov_ * x_moment) * inverse_determinant_;
    plane.at_centre = sum * inverse_count_ - (plane.slope_x * mean_x_ + plane.slope_y * mean_y_);
  }

 private:
  Lanes centre_x_, centre_y_;
  Lanes inverse_count_;
  Lanes mean_x_, mean_y_;
  Lanes var_x_, var_y_, cov_;
  Lanes inverse_determinant_;
  LaneMask is_level_;
};

/// How far the outlines at `level` lie beyond the centres of the extreme cells at one side, towards their neighbours
/// outside [cells], in [0, 1]; where there is none, the outline is the cell's edge.
MEMS_STICTION_INLINE void outlineBeyond(const Lanes& gap, const Lanes& outside, const Lanes& level, Lanes& beyond) {
  constexpr double kCellEdge = 0.5;
  const Lanes zero{};
  const Lanes rise = outside - gap;
  const Lanes share = (level - gap) / rise;
  const Lanes within = share > 0.0 ? (share < 1.0 ? share : zero + 1.0) : zero;
  beyond = (rise > 0.0) & (rise < GapField::kInvalidGap) ? within : zero + kCellEdge;
}

MEMS_STICTION_INLINE void findBaseRadius(const FourPatches& patches, const GapField& field, const Lanes& level,
                                         Lanes& base_radius) {
  Lanes gap[4], outside[4], beyond[4];  // of the patches, by Side
  for (std::size_t i = 0; i < kLanes; ++i) {
    gap[i] = patches[i].patch->extreme.gaps();
    outside[i] = patches[i].patch->extreme.outside();
  }
  transpose(gap[0], gap[1], gap[2], gap[3]);
  transpose(outside[0], outside[1], outside[2], outside[3]);
  for (const Side side : {kLeft, kRight, kTop, kBottom}) outlineBeyond(gap[side], outside[side], level, beyond[side]);
  Lanes cols, rows;
  fill([&](int i) { return patches[i].patch->max_col - patches[i].patch->min_col; }, cols);
  fill([&](int i) { return patches[i].patch->max_row - patches[i].patch->min_row; }, rows);
  const Lanes width = cols + beyond[kLeft] + beyond[kRight];
  const Lanes length = rows + beyond[kTop] + beyond[kBottom];
  base_radius = (width * field.pitchX() + length * field.pitchY()) / 4.0;
}

/// Zero where a summit is not above its base plane, or has none.
MEMS_STICTION_INLINE void cutOffBelowBase(Lanes& height) { height = height > 0.0 ? height : Lanes{}; }

/// Curvature of the circle through the rim and the summit of a cap.
MEMS_STICTION_INLINE void findCurvature(const Lanes& base_radius, const Lanes& height, Lanes& curvature) {
  curvature = 2.0 * height / (base_radius * base_radius + height * height);
}

}  // namespace

PatchCentre boxCentre(const ContactPatch& patch, const GapField& field) {
  const int first_row = (patch.min_row + patch.max_row) / 2;
  const int last_row = (patch.min_row + patch.max_row + 1) / 2;
  const int first_col = (patch.min_col + patch.max_col) / 2;
  const int last_col = (patch.min_col + patch.max_col + 1) / 2;
  return field.readGaps([&](const auto& gaps) {
    // which of the four is hard to predict: compared without branches; where a side has one middle, both are the same
    const std::ptrdiff_t above = field.cellAt(first_row, 0).index;
    const std::ptrdiff_t below = field.cellAt(last_row, 0).index;
    const double above_gap[2] = {gaps[above + first_col], gaps[above + last_col]};
    const double below_gap[2] = {gaps[below + first_col], gaps[below + last_col]};
    const int right_above = static_cast<int>(above_gap[1] < above_gap[0]);
    const int right_below = static_cast<int>(below_gap[1] < below_gap[0]);
    const double deepest_above = std::min(above_gap[0], above_gap[1]);
    const double deepest_below = std::min(below_gap[0], below_gap[1]);
    const int is_below = static_cast<int>(deepest_below < deepest_above);
    const int is_right = right_above + is_below * (right_below - right_above);
    return PatchCentre{field.cellAt(first_row + is_below, first_col + is_right),
                       std::min(deepest_above, deepest_below)};
  });
}

PatchCentre deepestCentre(const ContactPatch& patch, const GapField& field) {
  return {field.cellAt(patch.deepest), patch.deepest_gap};
}

MEMS_STICTION_VECTORIZED void capCouples(const CentredPatch (&patches)[kLanes], const GapField& field,
                                         double smallest_height, CapLanes& caps) {
  const Lanes zero{};
  const EdgeLanes edges(patches);
  const BasePlanes planes(edges, patches);
  Lanes latest_gap, deepest_gap, centre_gap;
  fill([&](int i) { return patches[i].patch->latest_gap; }, latest_gap);
  fill([&](int i) { return patches[i].patch->deepest_gap; }, deepest_gap);
  fill([&](int i) { return patches[i].centre->gap; }, centre_gap);
  const Lanes level = edges.count > 0.0 ? edges.gap / edges.count : latest_gap;
  findBaseRadius(patches, field, level, caps.base_radius);

  PlaneLanes gap;
  planes.fit(edges.gap, edges.x_gap, edges.y_gap, gap);
  Lanes lower_height;
  Lanes upper_height{};
  Lanes mid_slope_x = -0.5 * gap.slope_x;
  Lanes mid_slope_y = -0.5 * gap.slope_y;
  if (field.upperIsFlat()) {  // the lower surface is the gap, turned over
    lower_height = gap.at_centre - centre_gap;
  } else {
    Lanes lower_sum, x_lower_sum, y_lower_sum, lower_summit;
    fill([&](int i) { return patches[i].patch->boundary.lower; }, lower_sum);
    fill([&](int i) { return patches[i].patch->boundary.x_lower; }, x_lower_sum);
    fill([&](int i) { return patches[i].patch->boundary.y_lower; }, y_lower_sum);
    fill([&](int i) { return field.lowerHeight(patches[i].centre->cell.index); }, lower_summit);
    PlaneLanes lower;
    planes.fit(lower_sum, x_lower_sum, y_lower_sum, lower);
    lower_height = lower_summit - lower.at_centre;
    upper_height = lower.at_centre + gap.at_centre - (lower_summit + centre_gap);
    mid_slope_x = lower.slope_x + 0.5 * gap.slope_x;
    mid_slope_y = lower.slope_y + 0.5 * gap.slope_y;
    cutOffBelowBase(upper_height);
  }
  cutOffBelowBase(lower_height);
  mid_slope_x *= 2.0 / field.pitchX();
  mid_slope_y *= 2.0 / field.pitchY();
  caps.squared_slope = mid_slope_x * mid_slope_x + mid_slope_y * mid_slope_y;
  Lanes inverse_cos;
  takeRoot(1.0 + caps.squared_slope, inverse_cos);
  caps.cos_tilt = 1.0 / inverse_cos;

  const Lanes interference = level - deepest_gap;
  const Lanes height = lower_height + upper_height;
  const LaneMask is_low = (height <= kLowestHeightShare * interference) | (height <= 0.0);
  const Lanes in_its_place = interference < smallest_height ? zero + smallest_height : interference;
  caps.height = is_low ? in_its_place : height;
  Lanes curvature;
  findCurvature(caps.base_radius, is_low ? in_its_place : lower_height, curvature);
  if (!field.upperIsFlat()) {
    Lanes upper_curvature;
    findCurvature(caps.base_radius, upper_height, upper_curvature);
    curvature += is_low | (upper_height <= 0.0) ? zero : upper_curvature;
  }
  caps.composite_radius = 1.0 / curvature;
}

CapCouple capCouple(const ContactPatch& patch, const GapField& field, const PatchCentre& centre,
                    double smallest_height) {
  const CentredPatch centred{&patch, &centre};
  CapLanes lanes;
  capCouples({centred, centred, centred, centred}, field, smallest_height, lanes);
  return {lanes.base_radius[0],   lanes.height[0],   lanes.composite_radius[0],
          lanes.squared_slope[0], lanes.cos_tilt[0], centre.cell};
}

}  // namespace mems_stiction
