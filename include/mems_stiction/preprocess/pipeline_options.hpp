#pragma once

/// @file
/// Settings of the steps that clean a scan (pipeline.hpp), in their order; each is off by default.
/// What a step does stands in the header that bears its name. Lengths are in metres along the
/// scan's own axes, so that scans of different pitch share their settings. A step whose defaults
/// are left alone changes no pixel; validate() names what is out of range.
///
///     PipelineOptions options;  // the recipe for AFM scans
///     options.offset.enabled = options.spikes.enabled = options.fill.enabled = true;
///     options.lines.method = LineAlignment::kMedian;
///     options.level.shape = LevelShape::kPlane;

#include <string>
#include <vector>

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Settings of the step `region`; off while nothing is stated.
struct RegionOptions {
  double left = 0.0;         ///< of the rectangle [m], >= 0
  double top = 0.0;          ///< [m], >= 0
  double width = 0.0;        ///< [m], >= 0; 0 = to the right edge
  double height = 0.0;       ///< [m], >= 0; 0 = to the lower edge
  std::string polygon_file;  ///< text, a corner "x y" [m] in each line; empty = none
  std::string mask_file;  ///< image of the scan's size; pixels of 0, and missing ones, lie outside;
                          ///< empty = none

  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/region");
  bool isStated() const;
};

/// Whether the mean height is subtracted.
struct StageOffsetOptions {
  bool enabled = false;

  /// Keys are prefix + "/enabled".
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/offset");
};

enum class LineAlignment { kNone, kMedian, kMedianDifference, kPolynomial };

/// How scan lines are brought to one level.
struct LineAlignmentOptions {
  LineAlignment method = LineAlignment::kNone;
  int degree = 1;  ///< of the polynomials, in [0, 2]

  /// Keys are prefix + "/method" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/lines");
};

/// What counts as a spike.
struct SpikeOptions {
  bool enabled = false;
  double threshold = 6.0;  ///< in robust standard deviations, > 0
  int window =
      5;  ///< side of the window [pixels], odd (an even one counts as the next odd one), in [3, 31]

  /// Keys are prefix + "/threshold" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/spikes");
};

/// Which missing pixels get heights.
struct FillOptions {
  bool enabled = false;
  double max_fraction =
      0.05;            ///< share of missing pixels beyond which the scan is refused [-], in [0, 1]
  int max_hole = 200;  ///< larger holes stay invalid [pixels], in [1, 1000000]

  /// Keys are prefix + "/max_fraction" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/fill");
};

/// The shape of the tip: a cone with a spherical end.
struct TipOptions {
  double radius = 0.0;      ///< of the sphere [m], >= 0; 0 = off
  double half_angle = 0.0;  ///< between axis and flank of the cone [rad], in [0, 1.55]; 0 = a
                            ///< sphere with a cylinder

  /// Keys are prefix + "/radius" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/tip");
};

enum class LevelShape {
  kNone,
  kPlane,       ///< degree 1
  kPolynomial,  ///< degree 2
};

/// What is subtracted, and how it is fitted.
struct LevelOptions {
  LevelShape shape = LevelShape::kNone;
  bool robust = false;  ///< features and spikes have no say in the fit (polynomial_level.hpp)

  /// Keys are prefix and prefix + "_robust".
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/level");
};

/// The filter's cut-off.
struct LowPassOptions {
  double cutoff_wavelength = 0.0;  ///< lc [m], >= 0; 0 = off

  /// Keys are prefix + "/cutoff_wavelength".
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/low_pass");
};

enum class Interpolation { kCubic, kLanczos };

/// How many pixels per pixel, and what draws between them.
struct RefineOptions {
  int factor = 1;  ///< in [1, 16]; 1 = off
  Interpolation interpolation = Interpolation::kCubic;

  /// Keys are prefix + "/factor" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix = "preprocessing/refine");
};

/// Settings of every step; each is off by default.
struct PipelineOptions {
  RegionOptions region;
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

}  // namespace mems_stiction
