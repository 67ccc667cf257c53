#include "prediction/area_adhesion.hpp"

#include <algorithm>
#include <optional>

#include "approach/cell_islands.hpp"
#include "approach/far_gaps.hpp"
#include "loads/force_range.hpp"
#include "mechanics/transition.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/median.hpp"
#include "prediction/contact_solvers.hpp"
#include "separation/contact_curve.hpp"

namespace mems_stiction {
namespace {

/// Cells with which the curve is followed first, and by how much more when they do not suffice.
constexpr std::int64_t kFirstCells = 1 << 12;
constexpr std::int64_t kMoreCells = 8;
/// Places of a frame of islands, for each cell that may be kept, and those that are always allowed.
constexpr std::int64_t kPlacesPerCell = 8;
constexpr std::int64_t kFewPlaces = 1 << 20;
/// The bucket down to which cells with gaps up to this are found [m].
std::int64_t bucketOfGap(const AreaCells& cells, double gap) {
  return cells.counts().bucketOf(cells.highest() - gap) - 1;
}

AreaAdhesion withoutCells(const AreaCells& cells) {
  AreaAdhesion answer;
  answer.is_enough = false;
  answer.area = cells.area();
  return answer;
}

void takeMedians(const ContactCurve& curve, const Options& options, AreaAdhesion& answer) {
  if (curve.contacts().empty()) return;
  std::vector<double> radii;
  for (const ContactCurve::Contact& contact : curve.contacts())
    radii.push_back(contact.composite_radius);
  answer.median_composite_radius = medianOf(radii);
  // it rises with the radius
  answer.median_tabor_parameter =
      taborParameter(answer.median_composite_radius, options.interface.work_of_adhesion,
                     curve.frame().patchForces().contactModulus(), curve.frame().law().range());
}

/// Of the cells from a bucket on, and the gaps of all others.
/// @return nothing if their islands have no room
/// @throw CellsMissing if they do not suffice.
std::optional<AreaAdhesion> followCells(const AreaCells& cells, std::int64_t bucket,
                                        const Options& options) {
  const std::int64_t most_places = std::max(kPlacesPerCell * cells.limits().most_cells, kFewPlaces);
  GapField field;
  {
    const std::optional<HeightMap> frame =
        frameOfIslands(cells.cellsFrom(bucket), cells.pitchX(), cells.pitchY(),
                       std::min<std::int64_t>(
                           most_places, std::numeric_limits<std::int32_t>::max() / kPlacesPerCell));
    if (!frame) return std::nullopt;
    field.compute(*frame);
  }
  const FarGaps far(cells.counts(), bucket, cells.highest(),
                    forceRange(options.interface, options.lower, options.upper));
  ContactCurve curve;
  curve.comeToRest(field, options, &far);
  AreaAdhesion answer;
  answer.area = curve.frame().area();
  answer.status = curve.loading().status;
  answer.is_bonded_by_load = curve.loading().isBondedByLoad();
  answer.approach = curve.rest().approach;
  answer.separation_at_rest = curve.meanGap();
  answer.contact_stiffness = curve.stiffness();
  answer.contact_count = static_cast<int>(curve.contacts().size());
  answer.flows = curve.mayFlow(options.load);
  takeMedians(curve, options, answer);
  curve.part();
  const Unloading& unloading = curve.byContacts();
  answer.contact_area = std::min(unloading.contact_area, answer.area);
  answer.pull_off_force = unloading.force;
  answer.pull_off_exponents = unloading.force_exponents;
  answer.apparent_work_of_adhesion = unloading.work;
  answer.work_exponents = unloading.work_exponents;
  const int in_reach =
      unloading.force > 0.0 ? static_cast<int>(curve.inReachAtPullOff().patches().size()) : 0;
  answer.pull_off_contact_count = in_reach > 0 ? in_reach : answer.contact_count;
  curve.appendLoading(answer.curve);
  answer.curve.insert(answer.curve.end(), unloading.curve.begin(), unloading.curve.end());
  return answer;
}

}  // namespace

AreaAdhesion areaAdhesion(const AreaCells& cells, const Options& options) {
  options.check();
  if (!skillsOf(options.formulation).follows_areas) {
    throw OptionsError(
        {"approach/formulation: an area is followed by separation_curve alone, not by '" +
         options.formulation + "'"});
  }
  if (options.load.isPerArea()) {
    throw OptionsError(
        {"load/pressure, load/device_force: an area takes load/mechanical_load alone; scale them "
         "to it first"});
  }
  if (cells.counts().empty()) throw SurfaceError("the area has no valid cell");
  const HeightCounts& counts = cells.counts();
  const std::int64_t level = cells.levelBucket();
  if (level > counts.highest()) return withoutCells(cells);
  std::int64_t wanted = kFirstCells;
  std::int64_t bucket = std::clamp(counts.lowestWithin(wanted), level, counts.highest());
  for (;;) {
    double needed_gap = 0.0;
    try {
      std::optional<AreaAdhesion> answer = followCells(cells, bucket, options);
      if (answer) {
        answer->took_all_cells = bucket == level;
        return *answer;
      }
      return withoutCells(cells);
    } catch (const CellsMissing& missing) {
      needed_gap = missing.gap();
    }
    if (bucket == level) return withoutCells(cells);
    wanted *= kMoreCells;
    bucket = std::max(std::min(counts.lowestWithin(wanted), bucketOfGap(cells, needed_gap)), level);
  }
}

}  // namespace mems_stiction
