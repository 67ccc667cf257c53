#include "station/contact_cycles.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "prediction/asked_output.hpp"
#include "surface/wear.hpp"
#include "verdict/finding.hpp"

namespace mems_stiction {
namespace {

constexpr int kMostCycles = 1000000;  // each is a prediction, and a row of the result

/// Over the pixels that are valid in both [m].
double largestDifference(const cv::Mat& before, const cv::Mat& after) {
  double largest = 0.0;
  for (int row = 0; row < after.rows; ++row) {
    const double* old_line = before.ptr<double>(row);
    const double* new_line = after.ptr<double>(row);
    for (int col = 0; col < after.cols; ++col) {
      const double difference = std::abs(new_line[col] - old_line[col]);
      if (difference > largest) largest = difference;  // false for pixels that are not numbers
    }
  }
  return largest;
}

/// Its heights on the grid; those of a level plane are 0.
cv::Mat heightsOn(const HeightMap& grid, const HeightMap& surface) {
  return surface.empty() ? cv::Mat(cv::Mat::zeros(grid.rows(), grid.cols(), CV_64FC1))
                         : surface.asDouble().heights();
}

}  // namespace

ContactCyclesResult cycleContacts(const Options& options, const SurfacePair& surfaces, int count,
                                  const DeviceOptions& device,
                                  const UncertaintyOptions& uncertainty, const RunControl& control,
                                  const std::vector<LoadedScale>& scales,
                                  const std::optional<MeasuredScan>& scan) {
  if (count < 1 || count > kMostCycles) {
    throw OptionsError({"count: " + std::to_string(count) +
                        " is not allowed, must be an integer within [1, " +
                        std::to_string(kMostCycles) + "]"});
  }
  AdhesionModel model(withDeformedSurfaces(options));
  const MeasuredScan measured = scan ? *scan : asMeasured(options, surfaces);
  ContactCyclesResult result;
  const HeightMap& grid = surfaces.lower;
  result.surfaces = {surfaces.lower.asDouble(),
                     surfaces.upperIsPlane() ? HeightMap() : surfaces.upper.asDouble()};
  Wear wear;

  for (int cycle = 1; cycle <= count; ++cycle) {
    if (control.isCancelled()) return result;
    const SurfacePair worn = wear.on(surfaces);
    Prediction prediction = model.predict(worn);
    measured.flag(prediction);
    requireDeformedSurfaces(prediction);
    Evidence evidence;
    if (!scales.empty()) evidence.device = scales.front().scale.under(prediction);
    const Verdict verdict =
        verdictOf(prediction, device, uncertainty, options, measured.cell_area, evidence);

    ContactCycle row;
    row.cycle = cycle;
    row.status = prediction.status;
    row.is_lower_bound = prediction.isLowerBound();
    row.pull_off_force = prediction.pull_off_force;
    row.van_der_waals_force = prediction.van_der_waals_force;
    row.contact_area = prediction.contact_area;
    row.contact_area_jkr = prediction.contact_area_jkr;
    row.contact_fraction = prediction.contact_fraction;
    row.asperity_count = prediction.asperity_count;
    row.plastic_count = prediction.plastic_count;
    row.largest_change =
        std::max(largestDifference(heightsOn(grid, worn.lower), prediction.deformed_lower),
                 largestDifference(heightsOn(grid, worn.upper), prediction.deformed_upper));
    wear.add(surfaces, prediction.deformed_lower, prediction.deformed_upper);
    result.surfaces.lower = HeightMap(prediction.deformed_lower, grid.pitchX(), grid.pitchY());
    result.surfaces.upper = HeightMap(prediction.deformed_upper, grid.pitchX(), grid.pitchY());
    row.rms_height = heightStatistics(result.surfaces.lower).rms_height;
    row.sticks = verdict.sticks;
    row.margin = verdict.margin;
    row.margin_lower = verdict.margin_lower;
    row.margin_upper = verdict.margin_upper;
    row.peel_number = verdict.peel_number;
    row.peel_number_lower = verdict.peel_number_lower;
    row.peel_number_upper = verdict.peel_number_upper;
    row.is_peeled = isPeeled(verdict);
    row.pull_off_interval = pullOffInterval(prediction, options, uncertainty);
    if (cycle == 1 && std::isnan(row.ratio())) result.why_no_margin = verdict.reason;
    result.cycles.push_back(row);
    if (row.sticks == Sticks::kYes && result.first_sticking_cycle == 0)
      result.first_sticking_cycle = cycle;
    control.report(cycle, count);
  }
  result.is_complete = true;
  return result;
}

}  // namespace mems_stiction
