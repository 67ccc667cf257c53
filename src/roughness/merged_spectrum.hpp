#pragma once

/// @file
/// What do several scans of a surface, of any pitch and size, say together of its power spectral density?
///
/// Each scan speaks for the waves that it can see: shorter than its levelling has taken off and its window has blurred,
/// longer than its pixels. In bands of a constant ratio of wave numbers the periodograms of all of them are averaged,
/// each wave vector with the same weight: powers of a random surface are exponentially distributed about the density, so
/// this is the likeliest one (Jacobs, Junge, Pastewka, Surf. Topogr. 5 (2017) 013001, for bands of trust).

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// One scan, levelled by a plane.
struct SpectrumSource {
  std::string name;  ///< for sentences
  const HeightMap* surface = nullptr;
};

/// The waves of one band.
struct SpectrumBand {
  double wave_number = 0.0;  ///< geometric mean of the band [rad/m]
  double density = 0.0;      ///< [m^4]
  double freedom = 0.0;      ///< how many independent powers it is the mean of [-]
};

/// The spectrum of all scans.
struct MergedSpectrum {
  std::vector<SpectrumBand> bands;  ///< by ascending wave number, without holes
  bool rises_to_longest =
      false;                 ///< the longest waves that the scans show are still the largest: longer ones are missing
  double wanted_side = 0.0;  ///< that a scan must have to show where the spectrum ends [m], if it does not
  std::vector<std::string> warnings;  ///< scans that contradict each other, in words
};

/// @throw SurfaceError if no scan has a band of trust
MergedSpectrum mergedSpectrum(const std::vector<SpectrumSource>& scans);

}  // namespace mems_stiction
