#pragma once

/// @file
/// What becomes of a scan before the model sees it, once for all who ask: cleaned, under its
/// counter-surface, refined, with its roughness. Prediction, convergence, sweeps, cycles, wear and
/// preview take it from here.
///
///     ScanPreparer preparer(configuration);
///     const PreparedScan prepared = preparer.prepare(scan);
///     use(model.predict(prepared.model_surfaces), prepared.record);
///
/// It depends on the scan, on configuration.preprocessing and on the counter-surface with its pose.
/// It does not depend on what a model is told beside the surfaces, so that it serves as long as
/// none of the former changes.

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "mems_stiction/roughness/spatial_roughness.hpp"
#include "mems_stiction/roughness/unresolved_waves.hpp"

namespace mems_stiction {

class CounterSurfaceSource;
class Wear;

/// A scan as the model gets it. Copies share their pixels.
struct PreparedScan {
  SurfacePair surfaces;        ///< the cleaned scan and what it meets, on the scan's own grid
  SurfacePair model_surfaces;  ///< the same for the model: on a finer grid if preprocessing/refine
                               ///< asks for it
  int refinement = 1;          ///< cells of the model along a pixel of the scan [-]
  std::vector<std::string> warnings;  ///< about the scan as it came, in words (scan_sanity.hpp)
  std::vector<std::string> counter_warnings;  ///< about what it meets
  PreprocessRecord record;                    ///< what was done to the scan
  cv::Mat outside;  ///< pixels of the scan that preprocessing/region leaves out; empty = none
  ArealParameters roughness;  ///< of model_surfaces.lower, if output/roughness asks for it
  SpatialRoughness
      spatial_roughness;  ///< of surfaces.lower; NaN unless output/spatial_roughness asks for it
  double tip_limit = std::numeric_limits<double>::quiet_NaN();  ///< of surfaces.lower [m]; NaN
                                                                ///< where no tip is stated
  UnresolvedWaves short_waves;                                  ///< of the relief of `surfaces`
  double preparation_time =
      0.0;  ///< wall time of prepare() [s], part of the time of the scan's prediction
};

/// Surfaces on the model's grid that have become `after` of prepared.model_surfaces, as those of
/// the scan's grid: each pixel less the mean depth over it, so that untouched pixels keep their
/// heights. A plane stays one.
SurfacePair onScanGrid(const PreparedScan& prepared, const SurfacePair& after);

/// Prepares scan after scan with one configuration. One object serves one thread at a time.
class ScanPreparer {
 public:
  /// Reads and cleans the counter-surface's file, if it has one.
  /// @throw OptionsError if the configuration is out of range, also when that file cannot be used.
  explicit ScanPreparer(const Configuration& configuration);
  ~ScanPreparer();

  /// Where the counter-surface lies over the next scans, of every type; a plane takes the tilts.
  /// @throw OptionsError naming each refused value; then nothing changes.
  void setCounterSurfacePose(const SurfacePose& pose);
  const SurfacePose& counterSurfacePose() const;

  /// The counter-surface of the next scans, as it was measured; empty = the configured one again.
  void setMeasuredCounterSurface(const HeightMap& measured);

  /// @throw SurfaceError if either surface cannot be used, or the counter-surface is one that
  /// arrives beside the scan and none has, or the scan is beyond configuration.limits.
  PreparedScan prepare(const HeightMap& scan);

  /// The same scan under the counter-surface and pose of now; it is not cleaned again.
  /// @throw SurfaceError as prepare(); then nothing changes.
  void mount(PreparedScan& prepared);

  /// A prepared scan as the contacts before have left its surfaces, with the roughness that they
  /// have now.
  PreparedScan worn(const PreparedScan& as_made, const Wear& wear) const;

  /// Surfaces that are clean and in place, ready for the model: refined, without roughness.
  PreparedScan ready(const SurfacePair& surfaces) const;

  /// How many scans and counter-surfaces have been cleaned so far. For any thread.
  std::uint64_t cleanings() const;

 private:
  bool isRefining() const { return refinement_.refine.factor > 1; }
  void addRoughness(PreparedScan& prepared) const;
  static void addShortWaves(PreparedScan& prepared);
  /// Empty stays empty.
  HeightMap refinedUpper(const HeightMap& upper) const;

  ScanCleaner cleaner_;         ///< all steps but refinement
  PipelineOptions refinement_;  ///< refinement alone
  ScanLimits limits_;
  bool with_roughness_;
  SpatialRoughnessOptions spatial_roughness_;
  double tip_radius_;  ///< of the tip that drew the scan [m]; 0 = not known
  std::unique_ptr<CounterSurfaceSource> counter_surface_;
  std::atomic<std::uint64_t> scans_cleaned_{0};
};

}  // namespace mems_stiction
