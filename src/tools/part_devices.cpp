#include "part_devices.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "device/device_evidence.hpp"
#include "errors/error_text.hpp"
#include "evaluation/device_scans.hpp"
#include "evaluation/frame_load.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "prediction/asked_output.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

/// What the verdict needs of the prediction of a scan.
Configuration forVerdict(Configuration configuration) {
  configuration.model.output = figuresAlone();
  configuration.spatial_roughness.enabled = false;
  return configuration;
}

}  // namespace

PartDevices::PartDevices(const BatchArguments& arguments, std::vector<std::string> inputs,
                         const Configuration& configuration)
    : arguments_(arguments),
      inputs_(std::move(inputs)),
      configuration_(forVerdict(configuration)) {}

HeightMap PartDevices::surface(std::size_t number) {
  const BatchScan scan = scans_->read(number);
  if (!scan.reason.empty()) throw SurfaceError(scan.input + ": " + scan.reason);
  predictor_->preparer().setMeasuredCounterSurface(scan.of_bag.counter_surface);
  if (scan.place > 0) return scan.of_bag.surface;
  return openScanFile(scan.input, configuration_.scan, fileOptions(arguments_)).surface;
}

PartDevice PartDevices::device(const std::vector<RowOfPart>& rows,
                               const std::function<void(double)>& on_progress) {
  PartDevice part;
  const DeviceOptions& device = configuration_.device;
  if (rows.empty() || !wantsDeviceForce(device, configuration_.device_force)) return part;
  try {
    if (!scans_) {
      scans_.emplace(arguments_, inputs_, configuration_);
      predictor_.emplace(configuration_);
    }
    DeviceScans scans(configuration_);
    std::vector<PreparedScan> prepared;
    for (std::size_t i = 0; i < std::min(rows.size(), kMostScansOfDevice); ++i) {
      const HeightMap scan = surface(rows[i].number);
      prepared.push_back(predictor_->preparer().prepare(scan));
      scans.add("the scan of row " + std::to_string(rows[i].number), prepared.back());
    }
    if (rows.size() > kMostScansOfDevice) {
      part.warnings.push_back("the device's force is by the first " +
                              std::to_string(kMostScansOfDevice) + " of " +
                              std::to_string(rows.size()) + " scans");
    }
    Evidence evidence;
    evidence.device = deviceEvidence(scans.force(on_progress));
    const PreparedScan& finest = prepared[scans.finest()];
    const RowOfPart& row = rows[scans.finest()];
    if (row.half_space) {
      evidence.half_space = &*row.half_space;
      const bool is_flagged = configuration_.half_space.enabled == HalfSpaceUse::kFlagged;
      if (is_flagged) evidence.why_half_space = regimeFlagNames(flagsForHalfSpace(row.flags));
    }
    const Prediction prediction = predictor_->predict(finest);
    part.verdict = verdictOf(prediction, device, configuration_.uncertainty,
                             onFrame(configuration_.model, device, finest.surfaces),
                             finest.surfaces.lower.cellArea(), evidence);
    part.warnings.insert(part.warnings.end(), evidence.device->warnings.begin(),
                         evidence.device->warnings.end());
  } catch (const std::exception& error) {
    part.warnings.push_back("the device's own force has not been found: " + reasonOf(error));
  }
  return part;
}

}  // namespace mems_stiction
