#pragma once

/// @file
/// From a scan as it leaves an instrument to the surface that is brought into contact, with a
/// record of what was done.
///
/// The steps run in this order; each is off by default.
///
/// | step     | what               | why here                                                     |
/// |----------|--------------------|--------------------------------------------------------------|
/// | region   | region.hpp         | first: what does not count bears on no other step            |
/// | offset   | stage_offset.hpp   | early, so that everything after it has all its digits        |
/// | lines    | line_alignment.hpp | medians do not mind spikes; spikes show on aligned lines     |
/// | spikes   | spike_removal.hpp  | leaves holes                                                 |
/// | fill     | fill_holes.hpp     | closes missing pixels and those holes                        |
/// | tip      | tip_correction.hpp | the tip pointed along the instrument's z: before levelling   |
/// | level    | level.hpp          |                                                              |
/// | low_pass | low_pass.hpp       | its border needs a level surface                             |
/// | refine   | refine.hpp         | last: every step before it is cheaper on fewer pixels        |
///
///     PipelineOptions options;
///     options.level.shape = LevelShape::kPlane;
///     const CleanedScan prepared = cleanScan(scan, options);
///
/// For scan after scan, a ScanCleaner takes no memory after the first one of a size, but for `fill`
/// where holes are filled, and for `tip`, `low_pass` and `refine`.

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline_options.hpp"

namespace mems_stiction {

/// What one step did to a surface.
struct HeightChange {
  double rms_change =
      0.0;  ///< root mean square of the change of height over pixels valid before and after [m]
  long long changed_pixels = 0;  ///< whose height or validity changed
  long long invalid_pixels = 0;  ///< after the step
};

/// What one step did; changed_pixels of `refine` counts those of the finer grid.
struct PreprocessStep : HeightChange {
  std::string name;        ///< of the table above
  std::string parameters;  ///< "threshold=6 window=5"
  /// After `level`: rms height of the tilt and bow that a fit without the features still finds [m];
  /// else NaN.
  double tilt_left = std::numeric_limits<double>::quiet_NaN();
};

/// What the steps that ran did to one scan.
struct PreprocessRecord {
  std::vector<PreprocessStep> steps;  ///< those that ran, in order
  double tip_unreached_fraction =
      0.0;  ///< share of pixels that the tip could not reach [-]; 0 without `tip`
};

/// "spikes (threshold=6 window=5): rms change 1.2e-10 m; 14 pixels changed" per step, for people
/// and logs.
std::vector<std::string> recordLines(const PreprocessRecord& record);

/// The surface after the pipeline, and the record of it.
struct CleanedScan {
  HeightMap surface;
  PreprocessRecord record;
  cv::Mat outside;  ///< not 0 where a pixel lies outside the region, CV_8UC1; empty without one
};

/// Cleans scan after scan in the same memory. One object serves one thread at a time.
class ScanCleaner {
 public:
  ScanCleaner();
  /// Reads the files of the region.
  /// @throw OptionsError with the lines of validate(), if there are any, or naming a file that
  /// cannot be used.
  explicit ScanCleaner(const PipelineOptions& options);
  ~ScanCleaner();
  ScanCleaner(ScanCleaner&&) noexcept;
  ScanCleaner& operator=(ScanCleaner&&) noexcept;

  const PipelineOptions& options() const { return options_; }

  /// The result stays until the next scan. A copy of its surface stays longer: pixels that somebody
  /// shares are never written to again. Without any step the surface is the scan itself, to the
  /// bit, and shares its pixels.
  /// @throw SurfaceError if no pixel is valid, or more are missing than fill/max_fraction allows.
  const CleanedScan& clean(const HeightMap& scan);
  /// Lets go of the last surface, which without any step is the scan that somebody may wait to be
  /// free of.
  void letGo() { cleaned_.surface = HeightMap(); }

 private:
  struct Work;  ///< memory of the steps

  PipelineOptions options_;
  CleanedScan cleaned_;
  std::unique_ptr<Work> work_;
};

/// One scan by itself, as ScanCleaner does it.
/// @throw OptionsError, SurfaceError as ScanCleaner does.
CleanedScan cleanScan(const HeightMap& scan, const PipelineOptions& options);

}  // namespace mems_stiction
