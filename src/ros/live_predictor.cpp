#include "mems_stiction/ros/live_predictor.hpp"

#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/height_map/scan_sanity.hpp"
#include "mems_stiction/prediction/deformed_surfaces.hpp"
#include "mems_stiction/prediction/force_curve.hpp"
#include "mems_stiction/scan/plausibility.hpp"

namespace mems_stiction {
namespace {

/// The node's messages always carry the roughness.
Configuration withRoughness(Configuration configuration) {
  configuration.model.output.roughness = true;
  return configuration;
}

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

PartKey keyOf(const ScanOfPart& scan) {
  return {scan.provenance.part_id, scan.provenance.serial_id, scan.pool_settings_hash};
}

}  // namespace

LivePredictor::LivePredictor(const Configuration& configuration, bool accumulate_deformation)
    : settings_(configuration),
      predictor_(withRoughness(configuration)),
      accumulate_deformation_(accumulate_deformation) {}

void LivePredictor::requireCounterSurface() const {
  if (settings_.snapshot()->counter_surface.type == CounterSurfaceType::kTopic && !has_counter_surface_) {
    throw SurfaceError("no counter-surface has arrived yet (counter_surface/type is topic)");
  }
}

void LivePredictor::setPoseOf(const ReceivedScan& scan) {
  if (scan.counter_surface_pose) predictor_.preparer().setCounterSurfacePose(*scan.counter_surface_pose);
}

PreparedScan LivePredictor::prepare(const ReceivedScan& scan, const cv::Mat& wear) {
  requireCounterSurface();
  setPoseOf(scan);
  return predictor_.preparer().prepare(worn(scan.surface, wear));
}

const PreparedScan& LivePredictor::lastPrepared() {
  if (last_->is_reset) {
    last_->prepared = prepare(last_->received, last_->wear_before);
  } else if (last_->has_newer_counter) {
    setPoseOf(last_->received);
    predictor_.preparer().mount(last_->prepared);
  }
  last_->is_reset = last_->has_newer_counter = false;
  return last_->prepared;
}

PredictedScan LivePredictor::judged(const PreparedScan& prepared, const Configuration& settings,
                                    const ScanIdentity& identity, const std::vector<std::string>& warnings) {
  PredictedScan predicted;
  predictor_.setDevice(settings.device);
  predicted.prediction = predictor_.predict(prepared);
  predicted.verdict = verdictOf(predicted.prediction, settings.device, settings.uncertainty, predictor_.options(),
                                prepared.surfaces.lower.cellArea());
  predicted.preprocessing = prepared.record;
  predicted.formulation = predictor_.options().formulation;
  predicted.warnings = warnings;
  for (std::string& line : settingsWarnings(settings)) predicted.warnings.push_back(std::move(line));
  for (std::string& line : loadWarnings(predicted.prediction, predictor_.options())) {
    predicted.warnings.push_back(std::move(line));
  }
  Configuration used = settings;
  used.model = predictor_.options();
  used.counter_surface.pose = predictor_.preparer().counterSurfacePose();  // that of the scan, if it came with one
  predicted.provenance = provenanceOf(identity, used);
  predicted.curve = curveOf(predicted.prediction, predictor_.options().interface);
  return predicted;
}

void LivePredictor::addToPart(const ReceivedScan& scan, const Configuration& settings, PredictedScan& predicted) {
  predicted.pool_settings_hash = settingsHash(settings);  // without the pose that came with this scan
  predicted.part =
      parts_.add(keyOf({scan.header, predicted.provenance, predicted.pool_settings_hash}), scan.header.stamp.toNSec(),
                 statementOf(predicted.provenance.scan_name, predicted.prediction, predicted.verdict));
}

std::optional<PartNews> LivePredictor::judgeAgain(const ScanOfPart& scan, const Verdict& verdict) {
  const PartKey key = keyOf(scan);
  const std::optional<PooledVerdict> pooled = parts_.judgeAgain(key, scan.header.stamp.toNSec(), verdict);
  if (!pooled) return std::nullopt;
  const bool is_of_last_part = last_ && !(keyOf(last_->part) < key) && !(key < keyOf(last_->part));
  return PartNews{*pooled, is_of_last_part ? last_->part : scan};
}

PredictedScan LivePredictor::predictScan(const ReceivedScan& scan, const OutputOptions& output) {
  const SettingsOwner::Snapshot settings = settings_.snapshot();
  Options options = settings->model;
  options.output = output;
  options.output.asperities = true;  // whether or not somebody listens to them, the verdict is the same
  options.output.deformed_surfaces = output.deformed_surfaces || accumulate_deformation_;
  predictor_.setOptions(options);

  const PreparedScan prepared = prepare(scan, wear_);
  std::vector<std::string> warnings = scanWarnings(scan.surface);
  PredictedScan predicted = judged(prepared, *settings, scan.identity, warnings);
  if (accumulate_deformation_) requireDeformedSurfaces(predicted.prediction);
  addToPart(scan, *settings, predicted);
  last_ = LastScan{
      scan, prepared, {scan.header, predicted.provenance, predicted.pool_settings_hash}, std::move(warnings), wear_};
  last_->prepared.preparation_time = 0.0;  // later predictions of this scan do not prepare it
  if (accumulate_deformation_) {
    wear_ = deepened(wear_, prepared.surfaces.lower.asDouble().heights(), predicted.prediction.deformed_lower);
  }
  return predicted;
}

std::optional<PredictedScan> LivePredictor::predictLastScan() {
  if (!last_) return std::nullopt;
  const SettingsOwner::Snapshot settings = settings_.snapshot();
  Options options = settings->model;
  options.output = figuresOnly();
  predictor_.setOptions(options);
  return judged(lastPrepared(), *settings, last_->received.identity, last_->warnings);
}

PredictedScan LivePredictor::predictOnce(const ReceivedScan& scan, double voltage, double mechanical_load) {
  const SettingsOwner::Snapshot settings = settings_.snapshot();
  Options options = settings->model;
  options.output = figuresOnly();
  options.load.voltage = voltage;
  options.load.setMechanicalLoad(mechanical_load);
  predictor_.setOptions(options);  // refuses before the scan is touched
  return judged(prepare(scan, cv::Mat()), *settings, scan.identity, scanWarnings(scan.surface));
}

StationCase LivePredictor::stationCase(const ReceivedScan* given) {
  if (given != nullptr) return {given->header, given->identity, prepare(*given, cv::Mat()), settings_.snapshot()};
  if (!last_) throw SurfaceError("no scan yet, and none was given");
  return {last_->received.header, last_->received.identity, lastPrepared(), settings_.snapshot()};
}

void LivePredictor::setCounterSurface(const ReceivedScan& counter_surface) {
  predictor_.preparer().setMeasuredCounterSurface(counter_surface.surface);
  has_counter_surface_ = true;
  if (last_) last_->has_newer_counter = true;
}

void LivePredictor::resetSurface() {
  wear_.release();
  if (!last_ || last_->wear_before.empty()) return;
  last_->wear_before.release();
  last_->is_reset = true;
}

}  // namespace mems_stiction
