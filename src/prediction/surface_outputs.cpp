#include "mems_stiction/prediction/surface_outputs.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/deformation/modified_topography.hpp"

namespace mems_stiction {
namespace {

/// A map of this size and type that nobody else holds: the one that is there, if it can be written over.
void makeWritable(cv::Mat& map, int rows, int cols, int type) {
  const bool is_shared = map.u != nullptr && map.u->refcount > 1;
  if (is_shared) map.release();
  map.create(rows, cols, type);
}

}  // namespace

void fillSurfaceOutputs(const HeightMap& lower, const HeightMap* upper, const EquilibriumState& state,
                        ApproachSearch& search, const GapField& field, const AsperityLaw& law, const Options& options,
                        SurfaceOutputMemory& memory, Prediction& prediction) {
  const bool wants_map = options.output.contact_map;
  const bool wants_surfaces = options.output.deformed_surfaces;
  if (!wants_map) prediction.contact_map.release();
  if (!wants_surfaces) {
    prediction.deformed_lower.release();
    prediction.deformed_upper.release();
  }
  if (!wants_map && !wants_surfaces) return;
  if (wants_map) {
    makeWritable(prediction.contact_map, field.rows(), field.cols(), CV_8UC1);
    std::fill_n(prediction.contact_map.ptr<std::uint8_t>(), prediction.contact_map.total(), std::uint8_t{0});
  }
  if (wants_surfaces) {
    makeWritable(prediction.deformed_lower, field.rows(), field.cols(), CV_64FC1);
    makeWritable(prediction.deformed_upper, field.rows(), field.cols(), CV_64FC1);
    lower.heights().convertTo(prediction.deformed_lower, CV_64F);
    if (upper != nullptr) {
      upper->heights().convertTo(prediction.deformed_upper, CV_64F);
    } else {
      std::fill_n(prediction.deformed_upper.ptr<double>(), prediction.deformed_upper.total(), 0.0);
    }
  }

  const DeformationShare share(options.lower, options.upper, options.interface.hardness_ratio_limit, options.approach);
  std::vector<SurfaceChange>& changes = memory.changes;
  changes.clear();
  for (const AsperityResponse& asperity : search.responses()) {
    const double plasticity_index = law.plasticityIndexOf(asperity.radius);
    changes.push_back({share.lower(plasticity_index), share.upper(plasticity_index),
                       static_cast<std::uint8_t>(regimeOf(plasticity_index))});
  }

  PatchSweep& sweep = search.sweep();
  std::vector<std::int32_t>& columns = memory.columns;
  columns.resize(static_cast<std::size_t>(field.cols()));
  std::vector<double>& gaps = memory.gaps;
  gaps.resize(columns.size());
  const double past_contact = std::nextafter(state.approach, GapField::kInvalidGap);
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, gaps.data());
    const int count = columnsBelow(past_contact, gaps.data(), field.cols(), columns.data());
    std::uint8_t* map = wants_map ? prediction.contact_map.ptr<std::uint8_t>(row) : nullptr;
    double* lower_line = wants_surfaces ? prediction.deformed_lower.ptr<double>(row) : nullptr;
    double* upper_line = wants_surfaces ? prediction.deformed_upper.ptr<double>(row) : nullptr;
    for (int i = 0; i < count; ++i) {
      const std::int32_t col = columns[static_cast<std::size_t>(i)];
      const GridCell cell = field.cellAt(row, col);
      const std::int32_t patch = sweep.patchOf(cell);
      if (patch < 0) continue;
      const SurfaceChange& change = changes[static_cast<std::size_t>(sweep.livePlace(patch))];
      if (wants_map) map[col] = change.regime;
      if (wants_surfaces) {
        const double interference = state.approach - gaps[static_cast<std::size_t>(col)];
        lower_line[col] -= change.lower_share * interference;
        upper_line[col] += change.upper_share * interference;
      }
    }
  }
}

}  // namespace mems_stiction
