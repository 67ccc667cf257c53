#include "mems_stiction/prediction/surface_outputs.hpp"

#include <algorithm>

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
                        ApproachSearch& search, const GapField& field, const GapOrder& order, const AsperityLaw& law,
                        const Options& options, Prediction& prediction) {
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
  for (int i = 0; i < state.contact_count; ++i) {
    const OrderedCell& cell = order.cells()[static_cast<std::size_t>(i)];
    const std::int32_t place = search.sweep().livePlace(search.sweep().patchOf(cell.cell));
    const double plasticity_index = law.plasticityIndexOf(search.responses()[static_cast<std::size_t>(place)].radius);
    const int row = cell.row;
    const int col = cell.cell - cell.row * field.cols();
    if (wants_map)
      prediction.contact_map.at<std::uint8_t>(row, col) = static_cast<std::uint8_t>(regimeOf(plasticity_index));
    if (wants_surfaces) {
      const double interference = state.approach - cell.gap;
      prediction.deformed_lower.at<double>(row, col) -= share.lower(plasticity_index) * interference;
      prediction.deformed_upper.at<double>(row, col) += share.upper(plasticity_index) * interference;
    }
  }
}

}  // namespace mems_stiction
