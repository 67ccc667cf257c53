#include "mems_stiction/evaluation/prepared_scan.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "evaluation/counter_surface_source.hpp"
#include "height_map/scan_sanity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "preprocess/cleaning_warnings.hpp"
#include "preprocess/recipe.hpp"
#include "preprocess/refine.hpp"
#include "preprocess/tilt.hpp"
#include "roughness/filled_surface.hpp"
#include "roughness/tip_limit.hpp"
#include "settings/time_limit.hpp"
#include "surface/wear.hpp"

namespace mems_stiction {
namespace {

const Configuration& checked(const Configuration& configuration) {
  configuration.check();
  return configuration;  // NOLINT(bugprone-return-const-ref-from-parameter): the caller's own
}

PipelineOptions withoutRefinement(PipelineOptions options) {
  options.refine.factor = 1;
  return options;
}

/// A region is one of the scan: the counter-surface is another surface.
PipelineOptions withoutRegion(PipelineOptions options) {
  options.region = RegionOptions();
  return options;
}

PipelineOptions refinementAlone(const PipelineOptions& options) {
  PipelineOptions alone;
  alone.refine = options.refine;
  return alone;
}

/// Means over blocks of factor x factor cells.
cv::Mat blockMeans(const cv::Mat& cells, int factor) {
  cv::Mat means;
  cv::resize(cells, means, cells.size() / factor, 0.0, 0.0, cv::INTER_AREA);
  return means;
}

/// @throw SurfaceError for a scan without a height, with what to do
void requireValidPixel(const HeightMap& scan) {
  for (int row = 0; row < scan.rows(); ++row) {
    for (int col = 0; col < scan.cols(); ++col) {
      if (std::isfinite(scan.height(row, col))) return;
    }
  }
  throw SurfaceError(
      "the height map has no valid pixel: each is NaN, infinite, masked or marked as missing; did "
      "the instrument find the surface, and is the mark right (scan/invalid_value)?");
}

/// A refusal ends with what looks wrong in the scan, most likely its cause: lines that a stopped
/// scan did not reach.
CleanedScan cleanedOrWhyNot(ScanCleaner& cleaner, const HeightMap& scan) {
  try {
    return cleaner.clean(scan);
  } catch (const TimeLimitError&) {
    throw;
  } catch (const SurfaceError& error) {
    std::string reason = error.what();
    for (const std::string& line : scanWarnings(scan)) reason += "; " + line;
    throw SurfaceError(reason);
  }
}

/// The tilt of a scan that was not levelled.
/// - @p is_as_measured no step has changed the scan
void addTilt(const HeightMap& cleaned, const PipelineOptions& cleaning, bool is_as_measured,
             std::vector<std::string>& warnings) {
  if (cleaning.level.shape != LevelShape::kNone || !hasRelief(cleaned, cleaning)) return;
  const Tilt tilt = tiltOf(cleaned);
  if (!tilt.isLarge()) return;
  warnings.push_back(tilt.advice());
  if (!is_as_measured) return;
  const CleaningRecipe recipe = cleaningRecipe(cleaned);
  if (recipe.needsMoreThanAPlane()) warnings.back() += "; for this scan " + recipe.sentence();
}

}  // namespace

SurfacePair onScanGrid(const PreparedScan& prepared, const SurfacePair& after) {
  const int factor = prepared.refinement;
  const HeightMap& grid = prepared.surfaces.lower;
  const auto onGrid = [&](const HeightMap& scan, const HeightMap& before,
                          const HeightMap& now) -> HeightMap {
    if (now.empty()) return {};
    const cv::Mat heights = now.asDouble().heights();
    if (before.empty()) return {blockMeans(heights, factor), grid.pitchX(), grid.pitchY()};
    const cv::Mat depth = before.asDouble().heights() - heights;
    const cv::Mat brought = scan.asDouble().heights() - blockMeans(depth, factor);
    return {brought, grid.pitchX(), grid.pitchY()};
  };
  const SurfacePair& scan = prepared.surfaces;
  const SurfacePair& before = prepared.model_surfaces;
  return {onGrid(scan.lower, before.lower, after.lower),
          onGrid(scan.upper, before.upper, after.upper)};
}

ScanPreparer::ScanPreparer(const Configuration& configuration)
    : cleaner_(withoutRefinement(checked(configuration).preprocessing)),
      refinement_(refinementAlone(configuration.preprocessing)),
      limits_(configuration.limits),
      with_roughness_(configuration.model.output.roughness),
      spatial_roughness_(configuration.spatial_roughness),
      tip_radius_(configuration.tipRadius()),
      counter_surface_(
          std::make_unique<CounterSurfaceSource>(configuration.counter_surface, configuration.scan,
                                                 withoutRegion(cleaner_.options()), limits_)) {
  try {
    counter_surface_->load();
  } catch (const OptionsError&) {
    throw;
  } catch (const Error& error) {
    throw OptionsError({"counter_surface/file: " + std::string(error.what())});
  }
}

HeightMap ScanPreparer::refinedUpper(const HeightMap& upper) const {
  return upper.empty() || !isRefining() ? upper : refined(upper, refinement_.refine);
}

PreparedScan ScanPreparer::ready(const SurfacePair& surfaces) const {
  PreparedScan prepared;
  prepared.surfaces = surfaces;
  prepared.model_surfaces = surfaces;
  if (isRefining()) {
    CleanedScan fine = cleanScan(surfaces.lower, refinement_);
    prepared.refinement = refinement_.refine.factor;
    prepared.model_surfaces = {fine.surface, refinedUpper(surfaces.upper)};
    prepared.record = std::move(fine.record);
  }
  return prepared;
}

ScanPreparer::~ScanPreparer() = default;

void ScanPreparer::setCounterSurfacePose(const SurfacePose& pose) {
  counter_surface_->setPose(pose);
}

const SurfacePose& ScanPreparer::counterSurfacePose() const { return counter_surface_->pose(); }

void ScanPreparer::setMeasuredCounterSurface(const HeightMap& measured) {
  counter_surface_->setMeasured(measured);
}

std::uint64_t ScanPreparer::cleanings() const {
  return scans_cleaned_ + counter_surface_->cleanings();
}

PreparedScan ScanPreparer::prepare(const HeightMap& scan) {
  const auto start = std::chrono::steady_clock::now();
  limits_.checkSize(scan, refinement_.refine.factor);
  requireValidPixel(scan);
  const TimeLimit limit(limits_.longestTime(), ScanLimits::kMaxTime);
  ++scans_cleaned_;
  CleanedScan cleaned = cleanedOrWhyNot(cleaner_, scan);
  cleaner_.letGo();
  const ScanRemarks remarks = scanRemarks(scan);
  if (!remarks.implausible.empty()) limits_.checkPlausibility(cleaned.surface);
  PreparedScan prepared = ready({cleaned.surface, counter_surface_->over(cleaned.surface)});
  PreprocessRecord& record = cleaned.record;
  record.steps.insert(record.steps.end(), prepared.record.steps.begin(),
                      prepared.record.steps.end());
  prepared.record = std::move(record);
  prepared.warnings = remarks.all();
  for (const std::string& warning : cleaningWarnings(scan, cleaned.surface, cleaner_.options())) {
    prepared.warnings.push_back(warning);
  }
  addTilt(cleaned.surface, cleaner_.options(), prepared.record.steps.empty(), prepared.warnings);
  prepared.counter_warnings = counter_surface_->warnings(cleaned.surface);
  prepared.outside = cleaned.outside;
  TimeLimit::check();
  addRoughness(prepared);
  if (spatial_roughness_.enabled) {
    const std::string filled = filledSentence(prepared.surfaces.lower);
    if (!filled.empty()) prepared.warnings.push_back("output/spatial_roughness: " + filled);
  }
  if (tip_radius_ > 0.0) prepared.tip_limit = tipLimit(prepared.surfaces.lower, tip_radius_);
  addShortWaves(prepared);
  prepared.preparation_time =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return prepared;
}

void ScanPreparer::addShortWaves(PreparedScan& prepared) {
  prepared.short_waves =
      unresolvedWaves(prepared.surfaces.lower, prepared.surfaces.upper, prepared.tip_limit);
}

void ScanPreparer::addRoughness(PreparedScan& prepared) const {
  if (with_roughness_) prepared.roughness = arealParameters(prepared.model_surfaces.lower);
  if (spatial_roughness_.enabled) {
    prepared.spatial_roughness = spatialRoughness(prepared.surfaces.lower, spatial_roughness_);
  }
}

PreparedScan ScanPreparer::worn(const PreparedScan& as_made, const Wear& wear) const {
  if (wear.empty()) return as_made;
  PreparedScan prepared = as_made;
  prepared.model_surfaces = wear.on(as_made.model_surfaces);
  prepared.surfaces = as_made.refinement > 1 ? onScanGrid(as_made, prepared.model_surfaces)
                                             : prepared.model_surfaces;
  addRoughness(prepared);
  return prepared;
}

void ScanPreparer::mount(PreparedScan& prepared) {
  const HeightMap upper = counter_surface_->over(prepared.surfaces.lower);
  prepared.model_surfaces.upper = refinedUpper(upper);
  prepared.surfaces.upper = upper;
  prepared.counter_warnings = counter_surface_->warnings(prepared.surfaces.lower);
  addShortWaves(prepared);
}

}  // namespace mems_stiction
