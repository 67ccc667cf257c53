#include "device/scan_shortcomings.hpp"

#include <cmath>

#include "device/scan_list.hpp"
#include "errors/short_number.hpp"
#include "numeric/words.hpp"
#include "roughness/merged_spectrum.hpp"
#include "verdict/missing_scan.hpp"

namespace mems_stiction {
namespace {

/// The spectrum still rises towards its longest waves from this slope on, by more than two standard
/// errors [-].
constexpr double kRising = 1.0;
/// Scans contradict each other from this ratio of powers on, if it is so many standard errors
/// from 1.
constexpr double kContradiction = 1.5;
constexpr double kBeyondScatter = 4.0;
/// Of the finest scans, that which leaves out least.
UnresolvedWaves leastUnresolved(const std::vector<NamedScan>& scans) {
  const double finest = finestPitch(mapsOf(scans));
  UnresolvedWaves least;
  for (const NamedScan& scan : scans) {
    if (!showsSummits(scan.surface, finest)) continue;
    const UnresolvedWaves waves =
        scan.short_waves ? *scan.short_waves : unresolvedWaves(scan.surface, {}, 0.0);
    if (!(least.rms_height <= waves.rms_height)) least = waves;
  }
  return least;
}

void warnOfLongWaves(const SurfaceLaw& law, const std::vector<NamedScan>& scans, double side,
                     std::vector<std::string>& warnings) {
  const double longest = law.longestWave();
  if (!lacksLongWaves(law, side) || law.slope < kRising || law.slope < 2.0 * law.slope_deviation)
    return;
  const NamedScan* widest = &scans.front();
  for (const NamedScan& scan : scans) {
    if (scan.surface.cols() * scan.surface.pitchX() >
        widest->surface.cols() * widest->surface.pitchX()) {
      widest = &scan;
    }
  }
  warnings.push_back("roughness still rises towards the longest waves that the scans show (" +
                     shortNumber(longest * 1e6, 2) + " um, by " + widest->name +
                     "): measure a field of at least " + shortNumber(side * 1e6, 2) +
                     " um, pixels of " + shortNumber(longest / 16.0 * 1e9, 2) +
                     " nm will do. Until then the interval holds what longer waves may do");
}

void warnOfContradictions(const std::vector<NamedScan>& scans, std::vector<std::string>& warnings) {
  if (scans.size() < 2) return;
  std::vector<ScanWaves> waves;
  waves.reserve(scans.size());
  for (const NamedScan& scan : scans) waves.emplace_back(scan.surface);
  const std::vector<SpectrumDifference> differences = spectrumDifferences(waves);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const SpectrumDifference& difference = differences[i];
    if (!(std::abs(difference.logarithm) > std::log(kContradiction)) ||
        !(std::abs(difference.logarithm) > kBeyondScatter * difference.deviation)) {
      continue;
    }
    warnings.push_back(scans[i].name + " contradicts the other scans: between waves of " +
                       shortNumber(difference.shortest_wave * 1e6, 2) + " and " +
                       shortNumber(difference.longest_wave * 1e6, 2) + " um its rms heights are " +
                       shortNumber(std::exp(0.5 * difference.logarithm), 2) + " times theirs");
  }
}

}  // namespace

std::vector<std::string> missingLongWaves(const DeviceSurfaces& surfaces, const DeviceLaws& laws,
                                          double side) {
  std::vector<std::string> warnings;
  warnOfLongWaves(laws.lower, surfaces.scans, side, warnings);
  if (laws.upper) warnOfLongWaves(*laws.upper, surfaces.counter_surface, side, warnings);
  return warnings;
}

std::string missingShortWaves(const DeviceSurfaces& surfaces, const Options& model) {
  const std::string who = surfaces.scans.size() == 1 ? kTheScan : kNoScan;
  const UnresolvedWaves below = leastUnresolved(surfaces.scans);
  if (surfaces.counter_surface.empty()) return whatIsMissing(shortWaves(below, model), who);
  const UnresolvedWaves above = leastUnresolved(surfaces.counter_surface);
  UnresolvedWaves both = above.rms_height > below.rms_height ? above : below;
  both.rms_height = std::hypot(below.rms_height, above.rms_height);
  return whatIsMissing(shortWaves(both, model), who);
}

std::string missingPixels(const DeviceArea& area, double pitch) {
  const double width = std::sqrt(area.area / area.contacts);
  if (width > (kLeastPixelsAlong - 0.5) * pitch) return "";
  return "each of " + countText(static_cast<std::size_t>(area.contacts), "contact") + " on " +
         shortNumber(area.area, 3) + " m^2 is " + shortNumber(width * 1e9, 3) +
         " nm wide, less than " + std::to_string(kLeastPixelsAlong) + " pixels of " +
         shortNumber(pitch * 1e9, 3) + " nm: a scan with pixels of " +
         shortNumber(width * 1e9 / kLeastPixelsAlong, 2) +
         " nm or less is missing, or device/contacts is too large";
}

std::vector<std::string> contradictions(const DeviceSurfaces& surfaces) {
  std::vector<std::string> warnings;
  warnOfContradictions(surfaces.scans, warnings);
  warnOfContradictions(surfaces.counter_surface, warnings);
  return warnings;
}

}  // namespace mems_stiction
