#pragma once

/// @file
/// On which wavelengths does a surface carry its roughness?
///
///     C(q) = |integral of z w exp(-i q r) d^2r|^2 / (A <w^2>)         power spectral density [m^4]
///     m_n  = average over directions of the n-th spectral moment of a profile   [m^(2 - n)]
///          = (1, 1/2, 3/8 for n = 0, 2, 4) x integral of C |q|^n d^2q / (2 pi)^2
///
/// so m0 = <z^2>, m2 and m4 are the mean squared slope and curvature of a profile, averaged over
/// its directions, and <|grad z|^2> = 2 m2 (Nayak, J. Lubr. Technol. 93 (1971) 398; normalisation
/// of Jacobs, Junge and Pastewka, Surf. Topogr. 5 (2017) 013001). For z with the autocorrelation
/// sigma^2 exp(-r^2/l^2): C = pi l^2 sigma^2 exp(-q^2 l^2/4), m0 = sigma^2, m2 = 2 sigma^2/l^2, m4
/// = 12 sigma^2/l^4, alpha = 3.
///
/// Wave vectors run over the whole rectangle up to Nyquist's in each axis; dx may differ from dy,
/// rows from columns. Heights are taken about their (weighted) mean; levelling is the caller's.
/// `none` weights all pixels alike, for surfaces that wrap around their frame; `hann` fades the
/// frame out towards its borders, for measured ones: without it the jump from one border to the
/// other adds q^-2 to C and swamps m2 and m4. Missing pixels are filled (filled_surface.hpp). m4 of
/// a measured surface hangs on the pitch and on noise: it is a figure of this scan, not of the
/// material.

#include <vector>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

enum class SpectrumWindow { kNone, kHann };

/// Weights of the pixels along one axis: 1, or Hann's periodic window, centred on the pixels.
std::vector<double> windowWeights(int count, SpectrumWindow window);

/// Moments of a profile's spectrum, averaged over its directions.
struct SpectralMoments {
  double m0 = 0.0;     ///< [m^2]
  double m2 = 0.0;     ///< [-]
  double m4 = 0.0;     ///< [1/m^2]
  double alpha = 0.0;  ///< Nayak's parameter m0 m4/m2^2 [-], 1.5 or more for random surfaces; 0 for
                       ///< a constant surface
};

/// One ring of wave vectors.
struct SpectrumRing {
  double wave_number = 0.0;  ///< mean |q| of its wave vectors [rad/m]
  double density = 0.0;      ///< mean C [m^4]
  int count = 0;             ///< wave vectors in it
};

/// The spectral density of a surface, averaged over directions.
struct PowerSpectrum {
  SpectralMoments moments;
  /// Rings of the width 2 pi/(longer side), by ascending |q| up to the smaller of the two Nyquist
  /// wave numbers; rings without a wave vector are left out. |q| = 0 is not in it.
  std::vector<SpectrumRing> rings;
};

/// @throw SurfaceError if no pixel is valid, or a side has fewer than 2 pixels.
PowerSpectrum powerSpectrum(const HeightMap& surface, SpectrumWindow window);

/// A power law fitted to the rings, C ~ q^(-2 - 2 H).
struct HurstFit {
  double hurst_exponent = 0.0;  ///< H [-]; 0 to 1 for self-affine surfaces
  int rings = 0;                ///< that the fit runs over
};

/// Weighted least squares of log C over log q for wavelengths in [shortest, longest] [m]; each ring
/// weighs as its number of wave vectors, which is the inverse variance of log C.
/// @throw OptionsError if not 0 < shortest < longest.
/// @throw SurfaceError if fewer than 3 rings with power lie in that range; the message says which
/// range the spectrum has.
HurstFit fitHurstExponent(const PowerSpectrum& spectrum, double shortest_wavelength,
                          double longest_wavelength);

}  // namespace mems_stiction
