#pragma once

/// @file
/// From a scan as it leaves an instrument to the surface that is brought into contact, with a record of what was done.
///
/// The steps run in this order; each is off by default.
///
/// | step      | what                              | why here                                                      |
/// |-----------|-----------------------------------|---------------------------------------------------------------|
/// | offset    | stage_offset.hpp                  | first, so that everything after it has all its digits         |
/// | lines     | line_alignment.hpp                | medians do not mind spikes; spikes show only on aligned lines |
/// | spikes    | spike_removal.hpp                 | leaves holes                                                  |
/// | fill      | fill_holes.hpp                    | closes missing pixels and those holes                         |
/// | tip       | tip_correction.hpp                | the tip pointed along the instrument's z: before levelling    |
/// | level     | level_options.hpp                 |                                                               |
/// | low_pass  | low_pass.hpp                      | its border needs a level surface                              |
/// | refine    | refine.hpp                        | last: every step before it is cheaper on fewer pixels         |
///
///     PipelineOptions options;
///     options.level.shape = LevelShape::kPlane;
///     const CleanedScan cleaned = cleanScan(scan, options);

#include <string>
#include <utility>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/fill_holes.hpp"
#include "mems_stiction/preprocess/level_options.hpp"
#include "mems_stiction/preprocess/line_alignment.hpp"
#include "mems_stiction/preprocess/low_pass.hpp"
#include "mems_stiction/preprocess/refine.hpp"
#include "mems_stiction/preprocess/spike_removal.hpp"
#include "mems_stiction/preprocess/stage_offset.hpp"
#include "mems_stiction/preprocess/tip_correction.hpp"

namespace mems_stiction {

/// Settings of every step; each is off by default.
struct PipelineOptions {
  StageOffsetOptions offset;
  LineAlignmentOptions lines;
  SpikeOptions spikes;
  FillOptions fill;
  TipOptions tip;
  LevelOptions level;
  LowPassOptions low_pass;
  RefineOptions refine;

  void describe(OptionVisitor& visitor);
  /// One line per violated constraint; empty when all is well.
  std::vector<std::string> validate() const;
};

/// What one step did.
struct PreprocessStep {
  std::string name;              ///< of the table above
  std::string parameters;        ///< "threshold=6 window=5"
  double rms_change = 0.0;       ///< root mean square of the change of height over pixels valid before and after [m]
  long long changed_pixels = 0;  ///< whose height or validity changed; on the finer grid for `refine`
  long long invalid_pixels = 0;  ///< after the step
};

/// What the steps that ran did to one scan.
struct PreprocessRecord {
  std::vector<PreprocessStep> steps;    ///< those that ran, in order
  double tip_unreached_fraction = 0.0;  ///< share of pixels that the tip could not reach [-]; 0 without `tip`
};

/// The surface after the pipeline, and the record of it.
struct CleanedScan {
  HeightMap surface;
  PreprocessRecord record;
};

/// Without any step the surface is the scan itself, to the bit, and shares its pixels.
/// @throw OptionsError with the lines of validate(), if there are any.
/// @throw SurfaceError if no pixel is valid, or more are missing than fill/max_fraction allows.
CleanedScan cleanScan(const HeightMap& scan, const PipelineOptions& options);

/// "spikes (threshold=6 window=5): rms change 1.2e-10 m, 14 pixels changed" per step, for people and logs.
std::vector<std::string> recordLines(const PreprocessRecord& record);

}  // namespace mems_stiction
