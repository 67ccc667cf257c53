#include "evaluation/counter_surface_source.hpp"

#include <utility>

#include <opencv2/core.hpp>

#include "errors/short_number.hpp"
#include "height_map/scan_sanity.hpp"
#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "surface/alignment.hpp"

namespace mems_stiction {
namespace {

constexpr double kUsualShare =
    0.9;  // of the scan under its counter-surface: what poses leave uncovered at the edges

constexpr double kCopy =
    0.01;  // of the rms height: less between two surfaces, and one was drawn from the other

/// What looks wrong in a counter-surface as it was measured.
std::vector<std::string> warningsAbout(const std::string& name, const HeightMap& measured) {
  std::vector<std::string> lines = scanWarnings(measured);
  for (std::string& line : lines) line.insert(0, name + ": ");
  return lines;
}

/// Share of the scan's valid pixels that the counter-surface covers [-]; 1 of none.
double coveredShare(const HeightMap& scan, const HeightMap& upper) {
  const cv::Mat valid = validMask(scan.heights());
  const int count = cv::countNonZero(valid);
  return count > 0
             ? static_cast<double>(cv::countNonZero(valid & validMask(upper.heights()))) / count
             : 1.0;
}

/// Rms of what is between both, but for its mean, over the rms height of the scan [-]; NaN of a
/// flat one.
double misfit(const HeightMap& scan, const HeightMap& upper) {
  const cv::Mat heights = scan.asDouble().heights();
  const cv::Mat gap = upper.asDouble().heights() - heights;
  const cv::Mat valid = validMask(gap);
  cv::Scalar mean, of_gap, of_scan;
  cv::meanStdDev(gap, mean, of_gap, valid);
  cv::meanStdDev(heights, mean, of_scan, valid);
  return of_gap[0] / of_scan[0];
}

}  // namespace

CounterSurfaceSource::CounterSurfaceSource(const CounterSurfaceOptions& options,
                                           const ScanOptions& scan, const PipelineOptions& cleaning,
                                           const ScanLimits& limits)
    : options_(options), scan_(scan), cleaner_(cleaning), limits_(limits) {}

void CounterSurfaceSource::load() {
  if (options_.type != CounterSurfaceType::kFile || !surface_.empty()) return;
  ScanFileOptions file_options;
  file_options.import.channel = options_.channel;
  const std::string name = "counter_surface/file " + options_.file;
  const ScanFile measured = openScanFile(options_.file, scan_, file_options);
  warnings_ = warningsAbout(name, measured.surface);
  for (const std::string& note : measured.notes) warnings_.push_back(name + ": " + note);
  try {
    surface_ = mounted(measured.surface);
  } catch (const SurfaceError& error) {
    throw SurfaceError(name + ": " + error.what());
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
  if (!measured.empty() && options_.facing == CounterSurfaceFacing::kUnstated)
    throw OptionsError({facingComplaint()});
  measured_ = measured;
  measured_warnings_ = measured.empty() ? std::vector<std::string>()
                                        : warningsAbout("the counter-surface", measured);
  mounted_measured_ = HeightMap();
  placed_ = HeightMap();
}

HeightMap CounterSurfaceSource::over(const HeightMap& scan) {
  const SurfacePose& pose = options_.pose;
  const bool is_measured = !measured_.empty();
  if (options_.type == CounterSurfaceType::kTopic && !is_measured) {
    throw SurfaceError(
        "no counter-surface: counter_surface/type is topic, and no measured one was given");
  }
  const bool is_flat = options_.type == CounterSurfaceType::kFlat && !is_measured;
  if (is_flat && pose.tilt_x == 0.0 && pose.tilt_y == 0.0) return {};
  const bool fits_scan = options_.fitsScan() && !is_measured;
  if (!fits_scan && !placed_.empty() && haveSameGrid(placed_, scan)) return placed_;
  if (is_flat) {
    placed_ = tiltedFlat(scan, pose.tilt_x, pose.tilt_y);
    return placed_;
  }
  HeightMap surface = unplaced(scan);
  const bool is_on_the_grid = haveSameGrid(surface, scan);
  if (is_measured && !is_on_the_grid) return surface;
  const Beyond beyond =
      options_.isGenerated() && !is_measured ? Beyond::kPeriodic : Beyond::kInvalid;
  placed_ = is_on_the_grid && isIdentity(pose) ? surface : alignedTo(scan, surface, pose, beyond);
  return placed_;
}

std::vector<std::string> CounterSurfaceSource::warnings(const HeightMap& scan) const {
  std::vector<std::string> lines = measured_.empty() ? warnings_ : measured_warnings_;
  const bool is_beside_the_grid = placed_.empty() || !haveSameGrid(placed_, scan);
  if (is_beside_the_grid || (measured_.empty() && !options_.isMeasured())) return lines;
  const double share = coveredShare(scan, placed_);
  if (share < kUsualShare) {
    lines.push_back("the counter-surface covers " + shortNumber(100.0 * share) +
                    " % of the scan: over the rest it ends or was not measured and all figures are "
                    "those of what it "
                    "covers; are its pitch and counter_surface/pose right?");
  }
  if (misfit(scan, placed_) < kCopy) {
    lines.emplace_back(
        "the counter-surface fits the scan as its cast does: were both read from one file? One "
        "with its asperities up "
        "wants counter_surface/facing up");
  }
  return lines;
}

HeightMap CounterSurfaceSource::unplaced(const HeightMap& scan) {
  if (!measured_.empty()) {
    if (mounted_measured_.empty()) mounted_measured_ = mounted(measured_);
    return mounted_measured_;
  }
  load();
  if (!options_.isGenerated()) return surface_;
  if (surface_.empty() || !haveSameGrid(surface_, scan)) {
    surface_ = drawnCounterSurface(scan, options_);
  }
  return fittedCounterSurface(scan, surface_, options_);
}

HeightMap CounterSurfaceSource::mounted(const HeightMap& measured) {
  ++cleanings_;
  // A tip erodes from above: what is stated as mounted is cleaned as it was measured.
  const bool is_upside_down =
      cleaner_.options().tip.radius > 0.0 && options_.facing == CounterSurfaceFacing::kDown;
  const HeightMap cleaned = is_upside_down
                                ? turnedOver(cleaner_.clean(turnedOver(measured)).surface)
                                : cleaner_.clean(measured).surface;
  cleaner_.letGo();
  limits_.checkPlausibility(cleaned, true);
  return mountedCounterSurface(cleaned, options_.facing);
}

}  // namespace mems_stiction
