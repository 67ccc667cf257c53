#include "mems_stiction/roughness/spatial_roughness.hpp"

#include <algorithm>

#include <opencv2/core.hpp>

#include "mems_stiction/errors/errors.hpp"
#include "roughness/framed_roughness.hpp"
#include "roughness/power_spectrum.hpp"
#include "roughness/summits.hpp"

namespace mems_stiction {
namespace {

constexpr int kSmallestSpectrumSide = 8;
constexpr double kShortestInPitches = 8.0;
constexpr double kLongestInSides = 0.25;

double hurstExponent(const HeightMap& surface, const PowerSpectrum& spectrum,
                     const SpatialRoughnessOptions& options) {
  const double shortest = options.hurst_shortest_wavelength > 0.0
                              ? options.hurst_shortest_wavelength
                              : kShortestInPitches * std::max(surface.pitchX(), surface.pitchY());
  const double longest = options.hurst_longest_wavelength > 0.0
                             ? options.hurst_longest_wavelength
                             : kLongestInSides * std::min(surface.cols() * surface.pitchX(),
                                                          surface.rows() * surface.pitchY());
  if (shortest >= longest) return std::numeric_limits<double>::quiet_NaN();
  try {
    return fitHurstExponent(spectrum, shortest, longest).hurst_exponent;
  } catch (const SurfaceError&) {  // too few rings there
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// Every pixel of a frame that wraps around has eight neighbours.
HeightMap withNeighbours(const HeightMap& surface, FrameBoundary boundary) {
  if (boundary == FrameBoundary::kOpen) return surface;
  cv::Mat heights;
  cv::copyMakeBorder(surface.heights(), heights, 1, 1, 1, 1, cv::BORDER_WRAP);
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace

void SpatialRoughnessOptions::describe(OptionVisitor& visitor) {
  visitor.flag("output/spatial_roughness", enabled,
               "compute autocorrelation length, spectral moments, summits and Hurst's exponent of "
               "the scanned surface");
  visitor.number("output/hurst_shortest_wavelength", hurst_shortest_wavelength, "m",
                 Range::nonNegative(),
                 "Hurst's exponent is fitted from this wavelength; 0 = 8 pitches");
  visitor.number(
      "output/hurst_longest_wavelength", hurst_longest_wavelength, "m", Range::nonNegative(),
      "Hurst's exponent is fitted up to this wavelength; 0 = a quarter of the shorter side");
}

SpatialRoughness spatialRoughness(const HeightMap& surface,
                                  const SpatialRoughnessOptions& options) {
  return spatialRoughness(surface, options, FrameBoundary::kOpen);
}

SpatialRoughness spatialRoughness(const HeightMap& surface, const SpatialRoughnessOptions& options,
                                  FrameBoundary boundary) {
  SpatialRoughness roughness;
  const SpatialParameters spatial = spatialParameters(surface, boundary);
  roughness.sal = spatial.sal;
  roughness.str = spatial.str;
  const SummitParameters summits = summitParameters(withNeighbours(surface, boundary));
  roughness.summit_density = summits.density;
  roughness.mean_summit_radius = summits.mean_radius;
  if (std::min(surface.rows(), surface.cols()) < kSmallestSpectrumSide) return roughness;
  const PowerSpectrum spectrum =
      powerSpectrum(surface, boundary == FrameBoundary::kPeriodic ? SpectrumWindow::kNone
                                                                  : SpectrumWindow::kHann);
  roughness.m0 = spectrum.moments.m0;
  roughness.m2 = spectrum.moments.m2;
  roughness.m4 = spectrum.moments.m4;
  roughness.nayak = spectrum.moments.alpha;
  roughness.hurst = hurstExponent(surface, spectrum, options);
  return roughness;
}

}  // namespace mems_stiction
