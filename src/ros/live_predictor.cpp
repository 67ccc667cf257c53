#include "mems_stiction/ros/live_predictor.hpp"

#include <utility>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {
namespace {

OutputOptions figuresOnly() {
  OutputOptions output;
  output.deformed_surfaces = false;
  output.contact_map = false;
  output.asperities = false;
  output.energy_curve = false;
  return output;
}

/// The surface less what the contacts before have pressed in; a wear map of another size is that of another surface.
HeightMap worn(const HeightMap& surface, const cv::Mat& wear) {
  if (wear.size() != surface.heights().size()) return surface;
  const HeightMap wide = surface.asDouble();
  return {cv::Mat(wide.heights() - wear), surface.pitchX(), surface.pitchY()};
}

/// `wear` and the depth from `before` to `after`; cells that are invalid in either keep what they had.
cv::Mat deepened(const cv::Mat& wear, const cv::Mat& before, const cv::Mat& after) {
  cv::Mat depth = before - after;
  depth.setTo(0.0, depth != depth);  // NaN alone differs from itself
  return wear.size() == depth.size() ? cv::Mat(wear + depth) : depth;
}

}  // namespace

LivePredictor::LivePredictor(const Configuration& configuration, bool accumulate_deformation)
    : predictor_(configuration), single_predictor_(configuration), accumulate_deformation_(accumulate_deformation) {
  single_predictor_.setOutput(figuresOnly());
}

Prediction LivePredictor::run(ScanPredictor& predictor, const HeightMap& surface) const {
  if (predictor.configuration().counter_surface.type != CounterSurfaceType::kTopic) return predictor.predict(surface);
  if (!counter_surface_) {
    throw SurfaceError("no counter-surface has arrived yet (counter_surface/type is topic)");
  }
  return predictor.predict(surface, counter_surface_->surface);
}

Prediction LivePredictor::predictScan(const ReceivedScan& scan, const OutputOptions& output) {
  OutputOptions wanted = output;
  wanted.deformed_surfaces = output.deformed_surfaces || accumulate_deformation_;
  predictor_.setOutput(wanted);

  const HeightMap surface = worn(scan.surface, wear_);
  Prediction prediction = run(predictor_, surface);

  last_scan_ = scan;
  wear_before_last_scan_ = wear_;
  if (accumulate_deformation_) {
    wear_ = deepened(wear_, predictor_.prepared(surface).asDouble().heights(), prediction.deformed_lower);
  }
  return prediction;
}

std::optional<Prediction> LivePredictor::predictLastScan() {
  if (!last_scan_) return std::nullopt;
  predictor_.setOutput(figuresOnly());
  return run(predictor_, worn(last_scan_->surface, wear_before_last_scan_));
}

Prediction LivePredictor::predictOnce(const HeightMap& scan, double voltage, double mechanical_load) {
  single_predictor_.setLoad(voltage, mechanical_load);
  return run(single_predictor_, scan);
}

void LivePredictor::setCounterSurface(const ReceivedScan& counter_surface) { counter_surface_ = counter_surface; }

void LivePredictor::resetSurface() {
  wear_.release();
  wear_before_last_scan_.release();
}

}  // namespace mems_stiction
