#include "ros/live_predictor.hpp"

#include <algorithm>
#include <utility>

#include "configuration/named_files.hpp"
#include "device/device_evidence.hpp"
#include "evaluation/plausibility.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "prediction/asked_output.hpp"
#include "surface/wear.hpp"

namespace mems_stiction {
namespace {

/// The node's messages always carry the roughness.
Configuration withRoughness(Configuration configuration) {
  configuration.model.output.roughness = true;
  return configuration;
}

LoadFigures loadFiguresOf(const Prediction& prediction) {
  return {prediction.pull_off_force, prediction.contact_area, prediction.electrostatic_force};
}

/// Beyond every stamp [ns].
constexpr std::uint64_t kUnstamped = std::uint64_t{1} << 63U;

PartKey keyOf(const ScanOfPart& scan) {
  return {scan.provenance.part_id, scan.provenance.serial_id, scan.pool_settings_hash};
}

}  // namespace

LivePredictor::LivePredictor(const Configuration& configuration, bool accumulate_deformation)
    : settings_(withFilesOfNow(configuration)),
      predictor_(withRoughness(configuration)),
      accumulate_deformation_(accumulate_deformation) {}

void LivePredictor::requireCounterSurface() const {
  if (settings_.snapshot()->counter_surface.type == CounterSurfaceType::kTopic &&
      !has_counter_surface_) {
    throw SurfaceError("no counter-surface has arrived yet (counter_surface/type is topic)");
  }
}

void LivePredictor::setPoseOf(const ReceivedScan& scan) {
  if (scan.counter_surface_pose)
    predictor_.preparer().setCounterSurfacePose(*scan.counter_surface_pose);
}

PreparedScan LivePredictor::prepare(const ReceivedScan& scan) {
  requireCounterSurface();
  setPoseOf(scan);
  return predictor_.preparer().prepare(scan.surface);
}

const PreparedScan& LivePredictor::lastPrepared() {
  setPoseOf(last_->received);  // a scan of a call may have come with another
  if (last_->has_newer_counter) predictor_.preparer().mount(last_->as_made);
  if (last_->has_newer_counter || last_->is_reset) {
    last_->prepared = predictor_.preparer().worn(last_->as_made, last_->wear_before);
  }
  last_->is_reset = last_->has_newer_counter = false;
  return last_->prepared;
}

PredictedScan LivePredictor::judged(const PreparedScan& prepared, const Configuration& settings,
                                    const ScanIdentity& identity, const char* where_half_space,
                                    const ScanPredictor::OnModel& on_model) {
  PredictedScan predicted;
  Evidence evidence;
  if (wantsDeviceForce(settings.device, settings.device_force))
    evidence.why_no_device = kDeviceOnTopic;
  predictor_.setDevice(settings.device);
  predicted.prediction = predictor_.predict(prepared, on_model);
  predicted.half_space =
      halfSpaceCall(predicted.prediction, prepared, predictor_.options(), settings);
  const SolvedHalfSpace unsolved = unsolvedHalfSpace(predicted.half_space.objection);
  if (!predicted.half_space.objection.empty()) evidence.half_space = &unsolved;
  evidence.why_half_space = predicted.half_space.why;
  evidence.where_half_space = where_half_space;
  predicted.verdict = verdictOf(predicted.prediction, settings.device, settings.uncertainty,
                                predictor_.options(), prepared.surfaces.lower.cellArea(), evidence);
  predicted.preprocessing = prepared.record;
  predicted.formulation = predictor_.options().formulation;
  predicted.warnings =
      predictionWarnings(prepared, settings, predicted.prediction, predictor_.options());
  Configuration used = settings;
  used.model = predictor_.options();
  used.counter_surface.pose =
      predictor_.preparer().counterSurfacePose();  // that of the scan, if it came with one
  predicted.provenance = provenanceOf(identity, used);
  predicted.pool_settings_hash =
      settingsHash(settings);  // without the pose that came with this scan
  return predicted;
}

void LivePredictor::addToPart(const ReceivedScan& scan, PredictedScan& predicted) {
  const ScanOfPart added{scan.header, predicted.provenance, predicted.pool_settings_hash,
                         predicted.scan_id};
  predicted.part = parts_.add(
      keyOf(added), predicted.scan_id,
      statementOf(predicted.provenance.scan_name, predicted.prediction, predicted.verdict));
  if (!keyOf(added).isStated()) return;
  const auto is_overtaken = [&](const ScanOfPart& other) { return areOfOnePart(added, other); };
  newest_of_parts_.erase(
      std::remove_if(newest_of_parts_.begin(), newest_of_parts_.end(), is_overtaken),
      newest_of_parts_.end());
  newest_of_parts_.push_front(added);
  if (newest_of_parts_.size() > kMostParts) newest_of_parts_.pop_back();
}

std::optional<PartNews> LivePredictor::judgeAgain(const ScanOfPart& scan, const Verdict& verdict) {
  const PartKey key = keyOf(scan);
  const std::optional<PooledVerdict> pooled = parts_.judgeAgain(key, scan.id, verdict);
  if (!pooled) return std::nullopt;
  const ScanOfPart& newest = newestOf(scan);
  const bool is_of_pool = newest.pool_settings_hash == scan.pool_settings_hash;
  return PartNews{*pooled, is_of_pool ? newest : scan};
}

const ScanOfPart& LivePredictor::newestOf(const ScanOfPart& scan) const {
  const auto found =
      std::find_if(newest_of_parts_.begin(), newest_of_parts_.end(),
                   [&](const ScanOfPart& newest) { return areOfOnePart(newest, scan); });
  return found == newest_of_parts_.end() ? scan : *found;
}

PredictedScan LivePredictor::predictScan(const ReceivedScan& scan, const OutputOptions& output) {
  const SettingsOwner::Snapshot settings = settings_.snapshot();
  Options options = settings->model;
  options.output = output;
  options.output.asperities =
      true;  // whether or not somebody listens to them, the verdict is the same
  options.output.deformed_surfaces = output.deformed_surfaces || accumulate_deformation_;
  predictor_.setOptions(options);

  PreparedScan as_made = prepare(scan);
  const PreparedScan prepared = predictor_.preparer().worn(as_made, wear_);
  Wear wear = wear_;
  const auto addWear = [&](const Prediction& contact) {
    requireDeformedSurfaces(contact);
    wear.add(as_made.model_surfaces, contact.deformed_lower, contact.deformed_upper);
  };
  PredictedScan predicted =
      judged(prepared, *settings, scan.identity, kHalfSpaceOnTopic,
             accumulate_deformation_ ? ScanPredictor::OnModel(addWear) : nullptr);
  predicted.scan_id =
      scan.header.stamp.isZero() ? kUnstamped | ++unstamped_ : scan.header.stamp.toNSec();
  addToPart(scan, predicted);
  as_made.preparation_time = 0.0;  // later predictions of this scan do not prepare it
  last_ =
      LastScan{scan,
               as_made,
               prepared,
               {scan.header, predicted.provenance, predicted.pool_settings_hash, predicted.scan_id},
               wear_};
  last_->prepared.preparation_time = 0.0;
  wear_ = std::move(wear);
  figures_ = {settings, loadFiguresOf(predicted.prediction)};
  return predicted;
}

std::optional<PredictedScan> LivePredictor::predictLastScan() {
  if (!last_) return std::nullopt;
  const SettingsOwner::Snapshot settings = settings_.snapshot();
  Options options = settings->model;
  options.output = figuresAlone();
  predictor_.setOptions(options);
  PredictedScan predicted =
      judged(lastPrepared(), *settings, last_->received.identity, kHalfSpaceOnTopic);
  predicted.scan_id = last_->part.id;
  figures_ = {settings, loadFiguresOf(predicted.prediction)};
  return predicted;
}

std::optional<LoadFigures> LivePredictor::lastFigures() {
  if (!last_) return std::nullopt;
  if (figures_.settings != settings_.snapshot()) predictLastScan();
  return figures_.figures;
}

PredictedScan LivePredictor::predictOnce(const ReceivedScan& scan, double voltage,
                                         double mechanical_load) {
  const SettingsOwner::Snapshot settings = settings_.snapshot();
  Options options = settings->model;
  options.output = figuresAlone();
  options.load.voltage = voltage;
  options.load.setMechanicalLoad(mechanical_load);
  predictor_.setOptions(options);  // refuses before the scan is touched
  return judged(prepare(scan), *settings, scan.identity, kHalfSpaceOnDemand);
}

StationCase LivePredictor::stationCase(const ReceivedScan* given) {
  if (given != nullptr)
    return {given->header, given->identity, prepare(*given), settings_.snapshot()};
  if (!last_) throw SurfaceError("no scan yet, and none was given");
  return {last_->received.header, last_->received.identity, lastPrepared(), settings_.snapshot()};
}

void LivePredictor::setCounterSurface(const ReceivedScan& counter_surface) {
  predictor_.preparer().setMeasuredCounterSurface(counter_surface.surface);
  has_counter_surface_ = true;
  if (last_) last_->has_newer_counter = true;
  figures_ = {};
}

void LivePredictor::resetSurface() {
  wear_ = Wear();
  if (!last_ || last_->wear_before.empty()) return;
  last_->wear_before = Wear();
  last_->is_reset = true;
  figures_ = {};
}

}  // namespace mems_stiction
