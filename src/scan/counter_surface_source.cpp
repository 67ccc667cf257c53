#include "mems_stiction/scan/counter_surface_source.hpp"

#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/height_map/scan_file.hpp"

namespace mems_stiction {
namespace {

bool haveSameGrid(const HeightMap& a, const HeightMap& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a.pitchX() == b.pitchX() && a.pitchY() == b.pitchY();
}

PipelineOptions withoutRefinement(PipelineOptions options) {
  options.refine.factor = 1;
  return options;
}

}  // namespace

CounterSurfaceSource::CounterSurfaceSource(const CounterSurfaceOptions& options, const ScanOptions& scan,
                                           const PipelineOptions& cleaning)
    : options_(options), scan_(scan), cleaning_(withoutRefinement(cleaning)) {}

void CounterSurfaceSource::load() {
  if (options_.type != CounterSurfaceType::kFile || !surface_.empty()) return;
  ScanFileOptions file_options;
  file_options.import.channel = options_.channel;
  const HeightMap measured = readScanFile(options_.file, scan_, file_options);
  try {
    surface_ = mountedCounterSurface(cleaned(measured), options_.facing);
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

HeightMap CounterSurfaceSource::over(const HeightMap& scan) {
  if (options_.type == CounterSurfaceType::kTopic) {
    throw SurfaceError("no counter-surface: counter_surface/type is topic, and no measured one was given");
  }
  const SurfacePose& pose = options_.pose;
  if (options_.type == CounterSurfaceType::kFlat && pose.tilt_x == 0.0 && pose.tilt_y == 0.0) return {};
  if (!placed_.empty() && haveSameGrid(placed_, scan)) return placed_;
  if (options_.type == CounterSurfaceType::kFlat) {
    placed_ = tiltedFlat(scan, pose.tilt_x, pose.tilt_y);
    return placed_;
  }
  load();
  if (options_.isGenerated() && (surface_.empty() || !haveSameGrid(surface_, scan))) {
    surface_ = generatedCounterSurface(scan, options_);
  }
  const bool is_there = isIdentity(pose) && haveSameGrid(surface_, scan);
  placed_ = is_there ? surface_
                     : alignedTo(scan, surface_, pose, options_.isGenerated() ? Beyond::kPeriodic : Beyond::kInvalid);
  return placed_;
}

HeightMap CounterSurfaceSource::over(const HeightMap& scan, const HeightMap& measured) const {
  HeightMap mounted = mountedCounterSurface(cleaned(measured), options_.facing);
  // The model refuses grids that differ, and says how they do.
  if (isIdentity(options_.pose) || !haveSameGrid(mounted, scan)) return mounted;
  return alignedTo(scan, mounted, options_.pose);
}

HeightMap CounterSurfaceSource::cleaned(const HeightMap& measured) const {
  // A tip erodes from above: what is stated as mounted is cleaned as it was measured.
  const bool is_upside_down = cleaning_.tip.radius > 0.0 && options_.facing == CounterSurfaceFacing::kDown;
  if (!is_upside_down) return cleanScan(measured, cleaning_).surface;
  return turnedOver(cleanScan(turnedOver(measured), cleaning_).surface);
}

}  // namespace mems_stiction
