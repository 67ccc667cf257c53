#include "mems_stiction/evaluation/scan_predictor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "evaluation/block_maxima.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/scan_flags.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/verdict/resolution.hpp"
#include "settings/time_limit.hpp"
#include "verdict/missing_scan.hpp"

namespace mems_stiction {
namespace {

constexpr int kCoarsest = 4;
constexpr int kSmallestSide = 16;

/// The preparation has the roughness.
Options withoutRoughness(Options options) {
  options.output.roughness = false;
  return options;
}

/// What the model takes before it knows the frame.
Options withoutFrameLoad(Options options) {
  if (options.load.isPerArea()) options.load.setMechanicalLoad(0.0);
  return options;
}

HeightMap cropped(const HeightMap& surface, int multiple) {
  if (surface.empty()) return surface;
  const cv::Rect frame(0, 0, surface.cols() / multiple * multiple,
                       surface.rows() / multiple * multiple);
  return {surface.heights()(frame).clone(), surface.pitchX(), surface.pitchY()};
}

/// What the model says of finer surfaces, said of the pixels of the scan.
void bringToScan(const PreparedScan& prepared, Prediction& prediction) {
  const int factor = prepared.refinement;
  const HeightMap& fine = prepared.model_surfaces.lower;
  prediction.median_contact_pixels /= factor * factor;
  bringContactsToScan(prepared, prediction);
  if (!prediction.contact_map.empty())
    prediction.contact_map = blockMaxima(prediction.contact_map, factor);
  if (!prediction.deformed_lower.empty()) {
    const SurfacePair after =
        onScanGrid(prepared, {HeightMap(prediction.deformed_lower, fine.pitchX(), fine.pitchY()),
                              HeightMap(prediction.deformed_upper, fine.pitchX(), fine.pitchY())});
    prediction.deformed_lower = after.lower.heights();
    prediction.deformed_upper = after.upper.heights();
  }
}

SurfacePair decimated(const SurfacePair& surfaces, int factor) {
  return {decimated(surfaces.lower, factor),
          surfaces.upperIsPlane() ? HeightMap() : decimated(surfaces.upper, factor)};
}

}  // namespace

ScanPredictor::ScanPredictor(const Configuration& configuration)
    : preparer_(configuration),
      options_(withoutRoughness(configuration.model)),
      device_(configuration.device),
      model_(withoutFrameLoad(options_)),
      limits_(configuration.limits),
      min_contact_pixels_(configuration.resolution.min_contact_pixels),
      tip_radius_(configuration.tipRadius()) {}

void ScanPredictor::setOptions(const Options& options) {
  options.check();
  options_ = withoutRoughness(options);
  model_.setOptions(withoutFrameLoad(options_));
}

void ScanPredictor::setFrame(const PreparedScan& prepared) {
  if (options_.load.isPerArea()) model_.setOptions(onFrame(options_, device_, prepared.surfaces));
}

Prediction ScanPredictor::predict(const PreparedScan& prepared, const OnModel& on_model) {
  const TimeLimit limit(limits_.longestTime(), ScanLimits::kMaxTime, prepared.preparation_time);
  setFrame(prepared);
  Prediction prediction = model_.predict(prepared.model_surfaces);
  if (on_model) on_model(prediction);
  return finished(prepared, std::move(prediction));
}

Prediction ScanPredictor::predictAgain(const PreparedScan& prepared) {
  const TimeLimit limit(limits_.longestTime(), ScanLimits::kMaxTime, prepared.preparation_time);
  setFrame(prepared);
  return finished(prepared, model_.predictAgain(prepared.model_surfaces));
}

Prediction ScanPredictor::finished(const PreparedScan& prepared, Prediction&& prediction) const {
  if (prepared.refinement > 1) bringToScan(prepared, prediction);
  prediction.roughness = prepared.roughness;
  prediction.spatial_roughness = prepared.spatial_roughness;
  flagResolution(min_contact_pixels_, tip_radius_, prediction);
  countBelowTip(prepared.tip_limit, prediction);
  flagByScan(prepared, shortWaves(prepared.short_waves, options_), prediction);
  prediction.processing_time += prepared.preparation_time;
  return std::move(prediction);
}

Prediction ScanPredictor::predict(const HeightMap& scan,
                                  const HeightMap& measured_counter_surface) {
  preparer_.setMeasuredCounterSurface(measured_counter_surface);
  return predict(preparer_.prepare(scan));
}

std::vector<ConvergenceRow> ScanPredictor::convergence(const PreparedScan& prepared) {
  const SurfacePair& whole = prepared.surfaces;
  if (std::min(whole.lower.rows(), whole.lower.cols()) < kSmallestSide) {
    throw SurfaceError(
        "a scan of " + std::to_string(whole.lower.cols()) + " x " +
        std::to_string(whole.lower.rows()) +
        " pixels has no quarter resolution to compare with; must have 16 x 16 or more");
  }
  const SurfacePair surfaces(cropped(whole.lower, kCoarsest), cropped(whole.upper, kCoarsest));
  std::vector<ConvergenceRow> rows;
  for (int decimation = 1; decimation <= kCoarsest; decimation *= 2) {
    const PreparedScan coarse = preparer_.ready(decimated(surfaces, decimation));
    const Prediction prediction = predict(coarse);
    ConvergenceRow row;
    row.decimation = decimation;
    row.rows = coarse.surfaces.lower.rows();
    row.cols = coarse.surfaces.lower.cols();
    row.pitch_x = coarse.surfaces.lower.pitchX();
    row.pitch_y = coarse.surfaces.lower.pitchY();
    row.status = prediction.status;
    row.pull_off_force = prediction.pull_off_force;
    row.contact_area = prediction.contact_area;
    row.contact_area_jkr = prediction.contact_area_jkr;
    row.asperity_count = prediction.asperity_count;
    row.median_contact_pixels = prediction.median_contact_pixels;
    if (!rows.empty()) {
      row.pull_off_force_ratio = row.pull_off_force / rows.front().pull_off_force;
      row.contact_area_ratio = row.contact_area / rows.front().contact_area;
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace mems_stiction
