#include "evaluation/device_scans.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "device/device_evidence.hpp"
#include "device/scan_list.hpp"
#include "errors/short_number.hpp"
#include "evaluation/frame_load.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "surface/alignment.hpp"

namespace mems_stiction {
namespace {

/// What is between two surfaces that fit each other, as one surface under a plane.
HeightMap reliefBetween(const SurfacePair& surfaces) {
  const HeightMap& lower = surfaces.lower;
  const cv::Mat relief = lower.asDouble().heights() - surfaces.upper.asDouble().heights();
  return {relief, lower.pitchX(), lower.pitchY()};
}

/// For a counter-surface by itself, on its own grid.
Configuration ofCounterSurface(Configuration configuration) {
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.pose = SurfacePose();
  configuration.preprocessing.region = RegionOptions();
  configuration.spatial_roughness.enabled = false;
  return configuration;
}

/// Those of a device that one scan alone shows.
DeviceScans scansOfOne(const PreparedScan& prepared, const Configuration& configuration) {
  DeviceScans scans(configuration);
  scans.add("the scan", prepared);
  return scans;
}

}  // namespace

void DeviceScans::add(const std::string& name, const PreparedScan& prepared) {
  frames_.push_back(prepared.surfaces);
  if (configuration_.counter_surface.fitsScan()) {
    surfaces_.scans.push_back({name, reliefBetween(prepared.model_surfaces), prepared.short_waves});
    return;
  }
  surfaces_.scans.push_back({name, prepared.model_surfaces.lower, prepared.short_waves});
  const HeightMap& upper = prepared.model_surfaces.upper;
  if (upper.empty() || has_own_counter_surface_) return;
  const bool is_of_scan = configuration_.counter_surface.type == CounterSurfaceType::kTopic;
  const std::vector<NamedScan>& before = surfaces_.counter_surface;
  const bool is_there = std::any_of(before.begin(), before.end(), [&](const NamedScan& other) {
    return haveSameGrid(other.surface, upper);
  });
  if (is_there && !is_of_scan) return;
  UnresolvedWaves with_scan = prepared.short_waves;  // of the relief, which has them already
  with_scan.rms_height = 0.0;
  surfaces_.counter_surface.push_back({"the counter-surface of " + name, upper, with_scan});
}

std::vector<std::string> DeviceScans::addCounterSurface(const std::string& name,
                                                        const HeightMap& measured) {
  ScanPreparer preparer(ofCounterSurface(configuration_));
  preparer.setMeasuredCounterSurface(measured);
  const PreparedScan prepared = preparer.prepare(measured);
  const CounterSurfaceOptions& made = configuration_.counter_surface;
  if (made.fitsScan()) {
    throw OptionsError({"counter_surface/correlation: " + numberText(made.correlation) +
                        " is not allowed with a measured counter-surface, which fits as it was "
                        "measured; must be 0"});
  }
  if (!has_own_counter_surface_) surfaces_.counter_surface.clear();
  has_own_counter_surface_ = true;
  surfaces_.counter_surface.push_back({name, prepared.model_surfaces.upper});
  return prepared.warnings;
}

std::size_t DeviceScans::finest() const {
  const auto found = std::min_element(surfaces_.scans.begin(), surfaces_.scans.end(),
                                      [](const NamedScan& one, const NamedScan& other) {
                                        return comesBefore(one.surface, other.surface);
                                      });
  return static_cast<std::size_t>(found - surfaces_.scans.begin());
}

Options DeviceScans::loaded(const Options& model) const {
  return frames_.empty() ? model : onFrame(model, configuration_.device, frames_[finest()]);
}

std::string DeviceScans::whichScanIsLoaded(const Options& model) const {
  constexpr double kSameArea = 1.05;
  const double load = model.load.mechanical_load;
  if (model.load.isPerArea() || load == 0.0) return "";
  const auto [least, most] =
      std::minmax_element(surfaces_.scans.begin(), surfaces_.scans.end(),
                          [](const NamedScan& one, const NamedScan& other) {
                            return areaOf(one.surface) < areaOf(other.surface);
                          });
  if (areaOf(most->surface) < kSameArea * areaOf(least->surface)) return "";
  const NamedScan& scan = surfaces_.scans[finest()];
  return "load/mechanical_load of " + shortNumber(load) + " N presses the area of " + scan.name +
         ", the scan with the finest pixels, with " + shortNumber(load / areaOf(scan.surface)) +
         " Pa: load/pressure is the same for scans of any area";
}

DividedSurface DeviceScans::surface(int number, std::optional<double> depth) const {
  return {surfaces_, area(), loaded(configuration_.model), configuration_.device_force,
          number,    depth};
}

DeviceForce DeviceScans::force(const std::function<void(double)>& on_progress) const {
  return std::move(forces({configuration_.model}, on_progress).front());
}

std::vector<DeviceForce> DeviceScans::forces(const std::vector<Options>& models,
                                             const std::function<void(double)>& on_progress) const {
  std::vector<Options> all;
  all.reserve(models.size());
  for (const Options& model : models) all.push_back(loaded(model));
  std::vector<DeviceForce> found = deviceForces(surfaces_, area(), all, configuration_.uncertainty,
                                                configuration_.device_force, on_progress);
  for (std::size_t i = 0; i < models.size(); ++i) {
    const std::string loaded_scan = whichScanIsLoaded(models[i]);
    if (!loaded_scan.empty()) found[i].warnings.push_back(loaded_scan);
  }
  return found;
}

Evidence evidenceOfScan(const PreparedScan& prepared, const Configuration& configuration,
                        const std::function<void(double)>& on_progress, DeviceForce* extra) {
  Evidence evidence;
  if (!wantsDeviceForce(configuration.device, configuration.device_force)) return evidence;
  DeviceForce force;
  try {
    force = scansOfOne(prepared, configuration).force(on_progress);
    evidence.device = deviceEvidence(force);
  } catch (const Error& error) {
    evidence.why_no_device = error.what();
    force.warnings = {"the device's own force has not been found: " + evidence.why_no_device};
  }
  if (extra != nullptr) *extra = std::move(force);
  return evidence;
}

std::vector<LoadedScale> scalesUnder(const std::vector<LoadOptions>& loads,
                                     const PreparedScan& prepared,
                                     const Configuration& configuration,
                                     const std::function<void(double)>& on_progress,
                                     const std::optional<DeviceScans>& scans) {
  if (loads.empty() || !wantsDeviceForce(configuration.device, configuration.device_force))
    return {};
  std::vector<Options> models;
  for (const LoadOptions& load : loads) {
    models.push_back(configuration.model);
    models.back().load = load;
    models.back().load.mechanical_load = 0.0;  // the device's surfaces have another area
    models.back().load.pressure = load.mechanical_load / nominalArea(prepared.surfaces);
  }
  std::vector<DeviceForce> forces;
  try {
    forces = (scans ? *scans : scansOfOne(prepared, configuration)).forces(models, on_progress);
  } catch (const Error&) {
    return {};
  }
  std::vector<LoadedScale> scales;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    models[i].load = loads[i];
    const Prediction frame = AdhesionModel(models[i]).predict(prepared.model_surfaces);
    scales.push_back(
        {std::abs(loads[i].voltage),
         loads[i].mechanical_load,
         {deviceEvidence(forces[i]), frame.pull_off_force, frame.apparent_work_of_adhesion}});
  }
  return scales;
}

}  // namespace mems_stiction
