#include "mems_stiction/ros/live_predictor.hpp"

#include <utility>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {
namespace {

/// What the figures and the verdict need.
OutputOptions figuresOnly() {
  OutputOptions output;
  output.deformed_surfaces = false;
  output.contact_map = false;
  output.asperities = true;  // the verdict samples them
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

void LivePredictor::requireCounterSurface() const {
  if (configuration().counter_surface.type == CounterSurfaceType::kTopic && !counter_surface_) {
    throw SurfaceError("no counter-surface has arrived yet (counter_surface/type is topic)");
  }
}

PredictedScan LivePredictor::run(ScanPredictor& predictor, const HeightMap& surface, const ReceivedScan& scan) const {
  requireCounterSurface();
  if (scan.counter_surface_pose) predictor.setCounterSurfacePose(*scan.counter_surface_pose);
  const bool is_measured = predictor.configuration().counter_surface.type == CounterSurfaceType::kTopic;
  PredictedScan predicted;
  predicted.prediction =
      is_measured ? predictor.predict(surface, counter_surface_->surface) : predictor.predict(surface);
  const Configuration& configuration = predictor.configuration();
  predicted.verdict = verdictOf(predicted.prediction, configuration.device, configuration.uncertainty,
                                configuration.model, surface.cellArea());
  predicted.preprocessing = predictor.lastRecord();
  return predicted;
}

PredictedScan LivePredictor::predictScan(const ReceivedScan& scan, const OutputOptions& output) {
  OutputOptions wanted = output;
  wanted.asperities = true;  // whether or not somebody listens to them, the verdict is the same
  wanted.deformed_surfaces = output.deformed_surfaces || accumulate_deformation_;
  predictor_.setOutput(wanted);

  const HeightMap surface = worn(scan.surface, wear_);
  PredictedScan predicted = run(predictor_, surface, scan);

  last_scan_ = scan;
  wear_before_last_scan_ = wear_;
  if (accumulate_deformation_) {
    const cv::Mat before = predictor_.prepared(surface).asDouble().heights();
    wear_ = deepened(wear_, before, predicted.prediction.deformed_lower);
  }
  return predicted;
}

void LivePredictor::change(const RunningOptions& options) {
  RunningOptions load_apart = options;
  load_apart.load.voltage = load().voltage;
  load_apart.load.mechanical_load = load().mechanical_load;
  if (reconfigureMessage(load_apart) == reconfigureMessage(runningOptions())) {
    predictor_.setLoad(options.load.voltage, options.load.mechanical_load);
    return;
  }
  Configuration configuration = predictor_.configuration();
  options.applyTo(configuration);
  // Both are made before either is changed. The counter-surface is drawn or read again, so that nothing of the old
  // settings stays behind.
  ScanPredictor predictor(configuration);
  ScanPredictor single_predictor(configuration);
  single_predictor.setOutput(figuresOnly());
  predictor_ = std::move(predictor);
  single_predictor_ = std::move(single_predictor);
}

void LivePredictor::setLoad(double voltage, double mechanical_load) {
  RunningOptions options = runningOptions();
  options.load.voltage = voltage;
  options.load.mechanical_load = mechanical_load;
  change(options);
}

std::optional<PredictedScan> LivePredictor::predictLastScan() {
  if (!last_scan_) return std::nullopt;
  predictor_.setOutput(figuresOnly());
  return run(predictor_, worn(last_scan_->surface, wear_before_last_scan_), *last_scan_);
}

PredictedScan LivePredictor::predictOnce(const ReceivedScan& scan, double voltage, double mechanical_load) {
  single_predictor_.setLoad(voltage, mechanical_load);
  return run(single_predictor_, scan.surface, scan);
}

StationCase LivePredictor::stationCase(const ReceivedScan* given) const {
  if (given == nullptr && !last_scan_) throw SurfaceError("no scan yet, and none was given");
  requireCounterSurface();
  const ReceivedScan& scan = given != nullptr ? *given : *last_scan_;
  StationCase station_case;
  station_case.header = scan.header;
  station_case.configuration = configuration();
  if (scan.counter_surface_pose) station_case.configuration.counter_surface.pose = *scan.counter_surface_pose;
  station_case.scan = given != nullptr ? scan.surface : worn(scan.surface, wear_before_last_scan_);
  if (counter_surface_) station_case.measured_counter = counter_surface_->surface;
  return station_case;
}

void LivePredictor::setCounterSurface(const ReceivedScan& counter_surface) { counter_surface_ = counter_surface; }

void LivePredictor::resetSurface() {
  wear_.release();
  wear_before_last_scan_.release();
}

}  // namespace mems_stiction
