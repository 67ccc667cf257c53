#pragma once

/// @file
/// What do several scans of a surface, of any pitch and size, say together of its power spectral
/// density?
///
/// Each scan speaks for the waves that it can see: longer than some of its pixels, shorter than its
/// side. In bands of a constant ratio of wave numbers the powers of all of them are averaged, each
/// wave with the same weight: powers of a random surface are exponentially distributed about the
/// density, so that this is the likeliest one. What window and levelling have mixed up and taken
/// off the longest waves of a scan is computed from the spectrum found so far, and corrected for.
/// (Jacobs, Junge, Pastewka, Surf. Topogr. 5 (2017) 013001, for windows and bands of trust.)

#include <vector>

#include "roughness/scan_waves.hpp"

namespace mems_stiction {

/// Correlation lengths along a direction over those across it.
struct SpectrumStretch {
  double ratio = 1.0;      ///< >= 1 [-]
  double direction = 0.0;  ///< of the longer ones, from x towards y [rad]

  /// |q'| of a wave number vector, round after the stretch [rad/m].
  double roundWave(double q_x, double q_y) const {
    if (ratio == 1.0) return std::sqrt(q_x * q_x + q_y * q_y);
    const double cosine = std::cos(direction);
    const double sine = std::sin(direction);
    return std::hypot((cosine * q_x + sine * q_y) * std::sqrt(ratio),
                      (cosine * q_y - sine * q_x) / std::sqrt(ratio));
  }
};

/// The waves of one band.
struct SpectrumBand {
  double wave_number = 0.0;  ///< geometric mean of its waves [rad/m]
  double density = 0.0;      ///< [m^4]
  double freedom =
      0.0;  ///< degrees of freedom of the density: it is distributed as chi^2/freedom [-]
};

/// A spectrum by bands.
struct MergedSpectrum {
  std::vector<SpectrumBand> bands;  ///< by ascending wave number
  SpectrumStretch stretch;
  double largest_wave_number = 0.0;  ///< of the corners of the finest pixels [rad/m]

  /// By the straight line between bands in logarithms; flat below the first; 0 beyond the largest
  /// wave number.
  double densityAt(double wave_number) const;
  /// sqrt(integral of C |q|^(2 n) d^2q/(2 pi)^2) between two wave numbers: rms height, gradient,
  /// ... for n = 0, 1, ...
  double rootMean(int order, double from, double to) const;
};

/// Down to which waves a scan is believed.
struct ScanTrust {
  double least_waves = 0.0;       ///< along a side [-]
  double most_wave_number = 0.0;  ///< [rad/m]
};
/// Of each scan: the finest down to its pixels, others to ten of theirs; from two waves along a
/// side, the largest from one.
std::vector<ScanTrust> trustOf(const std::vector<ScanWaves>& scans);

/// Ratio and direction for which the spectrum by bands of |q'| is likeliest (Whittle); 1 unless
/// that is far likelier than round.
SpectrumStretch stretchOf(const std::vector<ScanWaves>& scans, const std::vector<ScanTrust>& trust);

/// @throw SurfaceError if no scan has a wave that is believed
MergedSpectrum mergedSpectrum(const std::vector<ScanWaves>& scans,
                              const std::vector<ScanTrust>& trust, const SpectrumStretch& stretch);

/// By how much the powers of one scan differ from those of all others, at the waves that both are
/// believed about.
struct SpectrumDifference {
  double logarithm = 0.0;      ///< of the ratio of powers, mean over waves [-]
  double deviation = 0.0;      ///< standard error of it; 0 where they have no waves in common
  double shortest_wave = 0.0;  ///< [m]
  double longest_wave = 0.0;   ///< [m]
};
/// Of each scan, none if it is alone.
std::vector<SpectrumDifference> spectrumDifferences(const std::vector<ScanWaves>& scans);

}  // namespace mems_stiction
