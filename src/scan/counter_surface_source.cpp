#include "mems_stiction/scan/counter_surface_source.hpp"

#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"

namespace mems_stiction {
namespace {

bool haveSameGrid(const HeightMap& a, const HeightMap& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a.pitchX() == b.pitchX() && a.pitchY() == b.pitchY();
}

}  // namespace

CounterSurfaceSource::CounterSurfaceSource(const CounterSurfaceOptions& options, const ScanOptions& scan,
                                           const PipelineOptions& cleaning)
    : options_(options), scan_(scan), cleaner_(cleaning) {}

void CounterSurfaceSource::load() {
  if (options_.type != CounterSurfaceType::kFile || !surface_.empty()) return;
  ScanFileOptions file_options;
  file_options.import.channel = options_.channel;
  const HeightMap measured = readScanFile(options_.file, scan_, file_options);
  try {
    surface_ = mounted(measured);
  } catch (const SurfaceError& error) {
    throw SurfaceError("counter_surface/file " + options_.file + ": " + error.what());
  }
}

void CounterSurfaceSource::setPose(const SurfacePose& pose) {
  std::vector<std::string> violations = rangeViolations(pose);
  if (!violations.empty()) throw OptionsError(std::move(violations));
  options_.pose = pose;
  placed_ = HeightMap();
}

void CounterSurfaceSource::setMeasured(const HeightMap& measured) {
  if (measured.empty() && measured_.empty()) return;
  measured_ = measured;
  mounted_measured_ = HeightMap();
  placed_ = HeightMap();
}

HeightMap CounterSurfaceSource::over(const HeightMap& scan) {
  const SurfacePose& pose = options_.pose;
  const bool is_measured = !measured_.empty();
  if (options_.type == CounterSurfaceType::kTopic && !is_measured) {
    throw SurfaceError("no counter-surface: counter_surface/type is topic, and no measured one was given");
  }
  const bool is_flat = options_.type == CounterSurfaceType::kFlat && !is_measured;
  if (is_flat && pose.tilt_x == 0.0 && pose.tilt_y == 0.0) return {};
  if (!placed_.empty() && haveSameGrid(placed_, scan)) return placed_;
  if (is_flat) {
    placed_ = tiltedFlat(scan, pose.tilt_x, pose.tilt_y);
    return placed_;
  }
  const HeightMap& surface = unplaced(scan);
  const bool is_on_the_grid = haveSameGrid(surface, scan);
  if (is_measured && !is_on_the_grid) return surface;
  const Beyond beyond = options_.isGenerated() && !is_measured ? Beyond::kPeriodic : Beyond::kInvalid;
  placed_ = is_on_the_grid && isIdentity(pose) ? surface : alignedTo(scan, surface, pose, beyond);
  return placed_;
}

const HeightMap& CounterSurfaceSource::unplaced(const HeightMap& scan) {
  if (!measured_.empty()) {
    if (mounted_measured_.empty()) mounted_measured_ = mounted(measured_);
    return mounted_measured_;
  }
  load();
  if (options_.isGenerated() && (surface_.empty() || !haveSameGrid(surface_, scan))) {
    surface_ = generatedCounterSurface(scan, options_);
  }
  return surface_;
}

HeightMap CounterSurfaceSource::mounted(const HeightMap& measured) {
  ++cleanings_;
  // A tip erodes from above: what is stated as mounted is cleaned as it was measured.
  const bool is_upside_down = cleaner_.options().tip.radius > 0.0 && options_.facing == CounterSurfaceFacing::kDown;
  const HeightMap cleaned =
      is_upside_down ? turnedOver(cleaner_.clean(turnedOver(measured)).surface) : cleaner_.clean(measured).surface;
  cleaner_.letGo();
  return mountedCounterSurface(cleaned, options_.facing);
}

}  // namespace mems_stiction
