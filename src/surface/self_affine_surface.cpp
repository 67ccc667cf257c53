#include "surface/self_affine_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "roughness/half_spectrum.hpp"
#include "roughness/power_spectrum.hpp"
#include "surface/random_field.hpp"

namespace mems_stiction {

void SelfAffineSurfaceOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.integer(prefix + "/rows", rows, Range::within(2, 32768), "rows of the surface");
  visitor.integer(prefix + "/cols", cols, Range::within(2, 32768), "columns of the surface");
  visitor.number(prefix + "/pitch_x", pitch_x, "m", Range::positive(),
                 "distance of neighbouring columns");
  visitor.number(prefix + "/pitch_y", pitch_y, "m", Range::positive(),
                 "distance of neighbouring rows");
  visitor.number(prefix + "/hurst_exponent", hurst_exponent, "", Range::within(0.0, 1.0),
                 "the power spectrum falls as wave number to -2 - 2 H");
  const double longest = std::max(cols * pitch_x, rows * pitch_y);
  const double shortest = 2.0 * std::max(pitch_x, pitch_y);
  visitor.number(prefix + "/rolloff_wavelength", rolloff_wavelength, "m",
                 Range{cutoff_wavelength, longest * (1.0 + 1e-12), true, false},
                 "longer wavelengths have the same spectral density as this one");
  visitor.number(prefix + "/cutoff_wavelength", cutoff_wavelength, "m",
                 Range{shortest * (1.0 - 1e-12), longest, false, false},
                 "shorter wavelengths are absent");
  visitor.enumeration(
      prefix + "/scale", scale,
      {{"rms_height", RoughnessScale::kRmsHeight}, {"rms_slope", RoughnessScale::kRmsSlope}},
      "which of the two figures is made exact; the other one is not used");
  visitor.number(prefix + "/rms_height", rms_height, "m", Range::nonNegative(),
                 "root mean square height");
  visitor.number(prefix + "/rms_slope", rms_slope, "", Range::nonNegative(),
                 "root mean square gradient");
  visitor.integer(prefix + "/seed", seed, Range::within(0, std::numeric_limits<int>::max()),
                  "the same seed gives the same surface");
}

std::vector<std::string> SelfAffineSurfaceOptions::validate(const std::string& prefix) const {
  return rangeViolations(*this, prefix);
}

HeightMap selfAffineSurface(const SelfAffineSurfaceOptions& options) {
  std::vector<std::string> violations = options.validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));

  const double rolloff = 2.0 * kPi / options.rolloff_wavelength;
  const double cutoff = 2.0 * kPi / options.cutoff_wavelength * (1.0 + 1e-12);
  const double exponent = -1.0 - options.hurst_exponent;
  const auto gain = [&](int row, int col) {
    const double q = std::hypot(waveNumber(col, options.cols, options.pitch_x),
                                waveNumber(row, options.rows, options.pitch_y));
    if (q > cutoff) return 0.0;
    return q <= rolloff ? 1.0 : std::pow(q / rolloff, exponent);
  };
  cv::Mat heights = filteredNoise(whiteNoise(options.rows, options.cols, options.seed), gain);
  const HeightMap unscaled(heights, options.pitch_x, options.pitch_y);
  if (options.scale == RoughnessScale::kRmsHeight) {
    heights *= options.rms_height / heightStatistics(unscaled).rms_height;
  } else {
    heights *= options.rms_slope /
               std::sqrt(2.0 * powerSpectrum(unscaled, SpectrumWindow::kNone).moments.m2);
  }
  return {heights, options.pitch_x, options.pitch_y};
}

}  // namespace mems_stiction
