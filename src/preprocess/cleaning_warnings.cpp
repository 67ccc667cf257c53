#include "preprocess/cleaning_warnings.hpp"

#include <algorithm>

#include "errors/short_number.hpp"
#include "height_map/scan_sanity.hpp"
#include "preprocess/tilt.hpp"

namespace mems_stiction {

static double widthOf(const HeightMap& scan) {
  return std::max(scan.cols() * scan.pitchX(), scan.rows() * scan.pitchY());
}

/// A filter that is longer than the scan leaves nothing.
static bool isSmoothedAway(const HeightMap& scan, const PipelineOptions& cleaning) {
  return cleaning.low_pass.cutoff_wavelength >= widthOf(scan);
}

bool hasRelief(const HeightMap& cleaned, const PipelineOptions& cleaning) {
  return !isSmoothedAway(cleaned, cleaning) &&
         std::min(cleaned.rows(), cleaned.cols()) >= kFewestPixelsOfASide;
}

std::vector<std::string> cleaningWarnings(const HeightMap& scan, const HeightMap& cleaned,
                                          const PipelineOptions& cleaning) {
  std::vector<std::string> warnings;
  if (isSmoothedAway(scan, cleaning)) {
    warnings.push_back("preprocessing/low_pass/cutoff_wavelength " +
                       shortNumber(cleaning.low_pass.cutoff_wavelength) +
                       " m is longer than the scan's width of " + shortNumber(widthOf(scan)) +
                       " m: it leaves no roughness and such a surface bonds");
  }
  const bool is_levelled_by_all =
      cleaning.level.shape != LevelShape::kNone && !cleaning.level.robust;
  if (is_levelled_by_all && hasRelief(cleaned, cleaning)) {
    const TiltLeft left = tiltLeft(cleaned, cleaning.level.shape == LevelShape::kPlane ? 1 : 2);
    if (left.isLarge()) warnings.push_back(left.advice());
  }
  return warnings;
}

}  // namespace mems_stiction
