#pragma once

/// @file
/// What cleaning did to a scan, step by step.

#include <limits>
#include <string>
#include <vector>

namespace mems_stiction {

/// What one step did to a surface.
struct HeightChange {
  double rms_change = 0.0;       ///< root mean square of the change of height over pixels valid before and after [m]
  long long changed_pixels = 0;  ///< whose height or validity changed
  long long invalid_pixels = 0;  ///< after the step
};

/// What one step did; changed_pixels of `refine` counts those of the finer grid.
struct PreprocessStep : HeightChange {
  std::string name;        ///< of the table above
  std::string parameters;  ///< "threshold=6 window=5"
  /// After `level`: rms height of the tilt and bow that a fit without the features still finds [m]; else NaN.
  double tilt_left = std::numeric_limits<double>::quiet_NaN();
};

/// What the steps that ran did to one scan.
struct PreprocessRecord {
  std::vector<PreprocessStep> steps;    ///< those that ran, in order
  double tip_unreached_fraction = 0.0;  ///< share of pixels that the tip could not reach [-]; 0 without `tip`
};

/// "spikes (threshold=6 window=5): rms change 1.2e-10 m; 14 pixels changed" per step, for people and logs.
std::vector<std::string> recordLines(const PreprocessRecord& record);

}  // namespace mems_stiction
