#pragma once

/// @file
/// What one scan may take of the machine, so that no scan stops the ones behind it.

#include <limits>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Scans beyond are refused with a sentence.
struct ScanLimits {
  static constexpr const char* kMaxTime = "limits/max_time";

  int max_pixels = 67108864;  ///< after refinement [-], >= 1
  double max_time = 60.0;     ///< of preparation and prediction together [s], >= 0; 0 = none

  void describe(OptionVisitor& visitor);

  /// @throw SurfaceError if the scan, refined, has more than max_pixels.
  void checkSize(const HeightMap& scan, int refinement) const;

  /// For TimeLimit [s]: infinity without a limit.
  double longestTime() const { return max_time > 0.0 ? max_time : std::numeric_limits<double>::infinity(); }
};

}  // namespace mems_stiction
