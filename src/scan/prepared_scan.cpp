#include "mems_stiction/scan/prepared_scan.hpp"

#include <chrono>
#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/time_limit.hpp"
#include "mems_stiction/preprocess/refine.hpp"

namespace mems_stiction {
namespace {

const Configuration& checked(const Configuration& configuration) {
  configuration.check();
  return configuration;
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

}  // namespace

ScanPreparer::ScanPreparer(const Configuration& configuration)
    : cleaner_(withoutRefinement(checked(configuration).preprocessing)),
      refinement_(refinementAlone(configuration.preprocessing)),
      limits_(configuration.limits),
      with_roughness_(configuration.model.output.roughness),
      spatial_roughness_(configuration.spatial_roughness),
      counter_surface_(configuration.counter_surface, configuration.scan, withoutRegion(cleaner_.options())) {
  try {
    counter_surface_.load();
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

PreparedScan ScanPreparer::prepare(const HeightMap& scan) {
  const auto start = std::chrono::steady_clock::now();
  limits_.checkSize(scan, refinement_.refine.factor);
  const TimeLimit limit(limits_.longestTime(), ScanLimits::kMaxTime);
  ++scans_cleaned_;
  CleanedScan cleaned = cleaner_.clean(scan);
  cleaner_.letGo();
  PreparedScan prepared = ready({cleaned.surface, counter_surface_.over(cleaned.surface)});
  PreprocessRecord& record = cleaned.record;
  record.steps.insert(record.steps.end(), prepared.record.steps.begin(), prepared.record.steps.end());
  prepared.record = std::move(record);
  prepared.outside = cleaned.outside;
  TimeLimit::check();
  if (with_roughness_) prepared.roughness = arealParameters(prepared.model_surfaces.lower);
  if (spatial_roughness_.enabled) {
    prepared.spatial_roughness = spatialRoughness(prepared.surfaces.lower, spatial_roughness_);
  }
  prepared.preparation_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return prepared;
}

void ScanPreparer::mount(PreparedScan& prepared) {
  const HeightMap upper = counter_surface_.over(prepared.surfaces.lower);
  prepared.model_surfaces.upper = refinedUpper(upper);
  prepared.surfaces.upper = upper;
}

}  // namespace mems_stiction
